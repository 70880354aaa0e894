// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// What a client of a shared link sends, what its owner sends, and what the vehicle answers, in any order: a
// byte before each frame chooses whose it is.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "firmware_link/link/link_packet.hpp"
#include "firmware_link/sharing/client_traffic.hpp"
#include "tests/fuzz/fuzz_bytes.hpp"

namespace swiftlet {
namespace {

/// The client reaches neither the owner's log blocks nor the vehicle's radio.
void check(const CrtpPacket& packet) {
  const std::span<const std::uint8_t> bytes = bytes_of(packet);
  if (!has_content(bytes)) std::abort();
  if (!is_on(bytes, kLogControlTopic)) return;
  if (bytes.size() < 3 || !ClientLogBlocks::has_number(bytes[2])) std::abort();
}

}  // namespace
}  // namespace swiftlet

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  ClientTraffic traffic;
  FuzzBytes bytes({data, size});
  while (!bytes.used_up()) {
    const std::uint8_t whose = bytes.byte();
    LinkFrame frame = bytes.frame();
    if (whose < 0x80)
      traffic.take(frame.packet(), frame.at);
    else if (whose < 0xF8)
      static_cast<void>(traffic.on_frame(frame));
    else
      traffic.abandon();
    if (const auto packet = traffic.next_packet((whose & 1U) != 0, frame.at)) check(*packet);
    while (traffic.take_answer()) continue;
  }
  return 0;
}
