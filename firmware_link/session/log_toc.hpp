// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_link/crtp/log_value.hpp"
#include "firmware_link/crtp/toc_item.hpp"

namespace swiftlet {

/// The vehicle's table of contents: the number of each log variable, a position in the firmware image that
/// changes with every build. Filled from replies; one thread at a time; allocates while it is filled.
class LogToc {
 public:
  /// Learns from a reply of the table-of-contents channel (5:0); false when it holds none. A changed crc
  /// clears all items: another firmware.
  bool on_reply(std::span<const std::uint8_t> packet);
  void add(std::uint16_t id, LogType type, std::string name);
  void clear();

  [[nodiscard]] const std::optional<TocInfo>& info() const { return info_; }
  [[nodiscard]] bool has(std::uint16_t id) const { return !name_of(id).empty(); }
  /// "group.name"; empty when unknown. Valid until the table changes.
  [[nodiscard]] std::string_view name_of(std::uint16_t id) const;
  /// The type it is stored in. Precondition: has(id).
  [[nodiscard]] LogType type_of(std::uint16_t id) const;

 private:
  struct Item {
    LogType type = LogType::kUint8;
    std::string name;
  };
  void on_info(const TocInfo& received);

  std::optional<TocInfo> info_;
  std::vector<Item> items_;  // by id
};

}  // namespace swiftlet
