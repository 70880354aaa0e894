// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_link/capture/capture_writer.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {

/// A short flight as a radio session would record it: one block of float pose and four ranges at 10 Hz,
/// moving along x at 0.5 m/s, the wall ahead coming nearer.
struct SyntheticCapture {
  int packets = 8;
  std::uint32_t first_ms = 1000;
  bool with_toc = true;

  static constexpr std::array<const char*, 7> kNames{"x", "y", "yaw", "front", "left", "back", "right"};

  [[nodiscard]] std::vector<LinkFrame> handshake() const {
    std::vector<LinkFrame> frames;
    const auto exchange = [&frames](const Bytes& request, const Bytes& reply) {
      const auto at = host_ms(1'700'000'000'000 + static_cast<std::int64_t>(frames.size()));
      frames.push_back(sent(request, at));
      frames.push_back(received(reply, at));
    };
    exchange(hex("5d 05"), hex("5d 05 00 00"));
    if (with_toc) {
      exchange(hex("5c 03"), hex("50 03 07 00 01 02 03 04 10 80"));
      for (std::uint16_t id = 0; id < std::uint16_t{kNames.size()}; ++id)
        exchange({0x5C, 2, low_byte(id), high_byte(id)},
                 toc_item_reply(id, id < 3 ? LogType::kFloat : LogType::kUint16,
                                id < 3 ? "stateEstimate" : "range", kNames[id]));
    }
    exchange(hex("5d 06 01 77 00 00 77 01 00 77 02 00 22 03 00 22 04 00 22 05 00 22 06 00"),
             hex("5d 06 01 00"));
    exchange(hex("5d 03 01 0a"), hex("5d 03 01 00"));
    return frames;
  }
  [[nodiscard]] LinkFrame data(int i) const {
    const std::uint32_t time_ms = first_ms + 100 * static_cast<std::uint32_t>(i);
    const LogPacket packet = LogPacket(1, time_ms)
                                 .f32(0.05F * static_cast<float>(i))
                                 .f32(0.0F)
                                 .f32(0.0F)
                                 .u16(static_cast<std::uint16_t>(2000 - 50 * i))
                                 .u16(700)
                                 .u16(32766)
                                 .u16(0);
    return received(packet.bytes(), host_ms(1'700'000'001'000 + 100L * i));
  }
  [[nodiscard]] std::vector<LinkFrame> frames() const {
    std::vector<LinkFrame> all = handshake();
    for (int i = 0; i < packets; ++i) {
      all.push_back(sent(hex("ff"), host_ms(1'700'000'000'999 + 100L * i)));
      all.push_back(data(i));
    }
    return all;
  }
};

inline CaptureVehicle radio_vehicle(std::uint8_t last_byte, std::uint8_t channel = 80) {
  CaptureVehicle vehicle;
  vehicle.address = {0xE7, 0xE7, 0xE7, 0xE7, last_byte};
  vehicle.channel = channel;
  return vehicle;
}

inline void write_capture(const std::string& path, const std::vector<LinkFrame>& frames,
                          const CaptureVehicle& vehicle = radio_vehicle(0xE7)) {
  Result<CaptureWriter> writer = CaptureWriter::create(path, vehicle);
  ASSERT_TRUE(writer.ok());
  for (const LinkFrame& frame : frames) ASSERT_TRUE(writer->write(frame).ok());
  ASSERT_TRUE(writer->flush().ok());
}

/// What it writes.
inline std::string capture_bytes(const std::vector<LinkFrame>& frames,
                                 const CaptureVehicle& vehicle = radio_vehicle(0xE7)) {
  const TemporaryFile file("bytes.pcap");
  write_capture(file.path(), frames, vehicle);
  return file.read();
}

}  // namespace swiftlet
