// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any lines as a page's messages on the WebSocket /live, while the run goes on. Byte 0, bit 0: of a
// recording.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/check.hpp"
#include "daemon/view/viewer.hpp"
#include "tests/fuzz/shown_run.hpp"

namespace swiftlet {
namespace {

/// The type of the message.
std::string checked(const WebMessage& message) {
  constexpr std::size_t kHeaderBytes = 16;
  if (!message.is_text) SWIFTLET_CHECK(message.bytes.size() >= kHeaderBytes, "bytes have a header");
  return message.is_text ? nlohmann::json::parse(message.bytes).at("type").get<std::string>() : "bytes";
}

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  ShownRun run;
  const ShownSource source{.title = "fuzz", .is_recording = (data[0] & 1U) != 0, .rate = 1.0};
  Viewer viewer(run.shared, source);
  drain(viewer, [](const WebMessage& message) { checked(message); });
  for_each_line({reinterpret_cast<const char*>(data) + 1, size - 1}, [&](std::string_view line) {
    viewer.take(line);
    run.grow();
    std::string last;
    drain(viewer, [&last](const WebMessage& message) { last = checked(message); });
    SWIFTLET_CHECK(last == "synced", "the page is told when it knows all");
  });
  return 0;
}
