// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/capture_format.hpp"

namespace swiftlet {

std::string CaptureVehicle::text() const {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text = kind == CaptureLinkKind::kRadio ? "radio " : "usb ";
  for (std::size_t i = 0; i < address_size(kind); ++i) {
    text += kDigits[address[i] >> 4];
    text += kDigits[address[i] & 0xF];
  }
  if (kind == CaptureLinkKind::kRadio) text += " channel " + std::to_string(channel);
  return text;
}

}  // namespace swiftlet
