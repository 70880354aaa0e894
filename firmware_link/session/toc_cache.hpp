// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "firmware_link/crtp/toc_item.hpp"

namespace swiftlet {

/// Tables of contents of known vehicles, by port, length and crc: a download takes a second or two, and every
/// reconnection would wait for it. Kept in memory and, with a directory, in one small text file each. One
/// thread at a time; allocates; touches files in load() and store().
class TocCache {
 public:
  /// An empty path: in memory only.
  explicit TocCache(std::filesystem::path directory = {}) : directory_(std::move(directory)) {}

  /// $CACHE_DIRECTORY, else $XDG_CACHE_HOME/swiftlet, else ~/.cache/swiftlet; empty where none of them is
  /// set.
  [[nodiscard]] static std::filesystem::path default_directory();

  /// All items, in the order of their ids; nullopt when this table is not known (or its file is damaged).
  [[nodiscard]] std::optional<std::vector<TocItem>> load(std::uint8_t port, const TocInfo& info);
  /// If the directory cannot be written, only the file is missing.
  void store(std::uint8_t port, const TocInfo& info, std::span<const TocItem> items);
  /// The table proved wrong.
  void forget(std::uint8_t port, const TocInfo& info);

 private:
  using Key = std::tuple<std::uint8_t, std::uint16_t, std::uint32_t>;
  static Key key_of(std::uint8_t port, const TocInfo& info) { return {port, info.count, info.crc}; }
  [[nodiscard]] std::filesystem::path file_of(std::uint8_t port, const TocInfo& info) const;

  std::filesystem::path directory_;
  std::map<Key, std::vector<TocItem>> known_;
};

}  // namespace swiftlet
