// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// The log handshake against a vehicle that answers as it should, wrongly, with anything at all, or not.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware_link/input/link_sample_source.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"
#include "tests/fuzz/check_samples.hpp"
#include "tests/fuzz/fuzz_bytes.hpp"

namespace swiftlet {
namespace {

/// Each byte chooses what comes next: see receive().
class MoodyLink final : public Link {
 public:
  explicit MoodyLink(FuzzBytes bytes) : bytes_(bytes) {
    vehicle_.variables = ScriptedVehicle::modern_variables();
    // The first byte leaves one variable out, or none: then another layout is asked for.
    const std::size_t left_out = bytes_.byte();
    if (left_out < vehicle_.variables.size())
      vehicle_.variables.erase(vehicle_.variables.begin() + static_cast<std::ptrdiff_t>(left_out));
  }

  Status send(std::span<const std::uint8_t> packet) override {
    SWIFTLET_CHECK(!packet.empty() && packet.size() <= kMaxCrtpPacket, "a request is a CRTP packet");
    request_.assign(packet.begin(), packet.end());
    hand_back_ = true;
    return {};
  }
  Result<LinkFrame> receive(Duration timeout) override {
    if (hand_back_) {
      hand_back_ = false;
      return sent(request_, now_);
    }
    if (bytes_.used_up()) return Error{ErrorCode::kEndOfRecording, "used up"};
    now_ += std::chrono::milliseconds(1);
    const std::uint8_t mood = bytes_.byte();
    if (mood < 0x80 && !request_.empty()) {
      // Once for each request would be right; 0x40: with one byte changed.
      std::optional<Bytes> reply = vehicle_.answer(request_);
      if (reply && (mood & 0x40) != 0) (*reply)[bytes_.byte() % reply->size()] = bytes_.byte();
      if (reply) return received(*reply, now_);
    }
    if (mood < 0xA0) return log_data();
    if (mood < 0xD0) return anything();
    now_ += timeout;
    return Error{ErrorCode::kTimeout, "no packet"};
  }

 private:
  Result<LinkFrame> log_data() {
    now_ += std::chrono::milliseconds(50);
    const auto time_ms = static_cast<std::uint32_t>(now_.time_since_epoch() / std::chrono::milliseconds(1));
    const std::vector<Bytes> packets = vehicle_.data(time_ms);
    if (packets.empty()) return Error{ErrorCode::kTimeout, "no packet"};
    return received(packets[bytes_.byte() % packets.size()], now_);
  }
  LinkFrame anything() {
    LinkFrame frame = bytes_.frame();
    frame.at = now_;
    frame.direction = LinkDirection::kFromVehicle;
    return frame;
  }

  FuzzBytes bytes_;
  ScriptedVehicle vehicle_;
  Bytes request_;
  bool hand_back_ = false;
  HostTime now_{};
};

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swiftlet::LinkInput input;
  input.name = "fuzz";
  input.starts_logging = true;
  input.link = std::make_unique<swiftlet::MoodyLink>(swiftlet::FuzzBytes({data, size}));
  swiftlet::LinkSampleSource source(std::move(input));
  swiftlet::drain(source);
  return 0;
}
