// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any sequence of frames, both directions, through log session, extractor and assembler.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "firmware_link/input/link_sample_source.hpp"
#include "tests/fuzz/check_samples.hpp"
#include "tests/fuzz/fuzz_bytes.hpp"

namespace swiftlet {
namespace {

class FuzzedLink final : public Link {
 public:
  explicit FuzzedLink(FuzzBytes bytes) : bytes_(bytes) {}
  Result<LinkFrame> receive(Duration /*timeout*/) override {
    if (bytes_.used_up()) return Error{ErrorCode::kEndOfRecording, "used up"};
    return bytes_.frame();
  }
  Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }

 private:
  FuzzBytes bytes_;
};

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swiftlet::LinkInput input;
  input.name = "fuzz";
  input.link = std::make_unique<swiftlet::FuzzedLink>(swiftlet::FuzzBytes({data, size}));
  swiftlet::LinkSampleSource source(std::move(input));
  swiftlet::drain(source);
  return 0;
}
