// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any lines as messages of a client of Foxglove's protocol, while the run goes on. Byte 0, bit 0: of a
// recording.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/check.hpp"
#include "daemon/view/foxglove_conversation.hpp"
#include "tests/fuzz/shown_run.hpp"

namespace swiftlet {
namespace {

void check(const WebMessage& message) {
  constexpr std::size_t kHeaderBytes = 13;
  if (message.is_text) {
    SWIFTLET_CHECK(nlohmann::json::parse(message.bytes).contains("op"), "a text has an operation");
    return;
  }
  SWIFTLET_CHECK(message.bytes.size() > kHeaderBytes && message.bytes[0] == 1, "bytes are data");
  SWIFTLET_CHECK(nlohmann::json::accept(message.bytes.substr(kHeaderBytes)), "data is JSON");
}

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  ShownRun run;
  const ShownSource source{.title = "fuzz", .is_recording = (data[0] & 1U) != 0, .rate = 2.0};
  MonotonicTime now{};
  FoxgloveConversation conversation(run.shared, source, [&now] { return now; });
  drain(conversation, check);
  for_each_line({reinterpret_cast<const char*>(data) + 1, size - 1}, [&](std::string_view line) {
    conversation.take(line);
    run.grow();
    now += std::chrono::milliseconds(700);
    drain(conversation, check);
  });
  return 0;
}
