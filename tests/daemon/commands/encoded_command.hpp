// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swiftlet/command_t.hpp"

namespace swiftlet {

inline std::vector<std::uint8_t> encoded_command(int action, const std::string& name = "") {
  command_t message;
  message.action = static_cast<std::int8_t>(action);
  message.name = name;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace swiftlet
