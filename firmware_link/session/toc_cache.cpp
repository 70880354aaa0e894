// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/toc_cache.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

namespace swiftlet {
namespace {

constexpr const char* kTitle = "swiftlet-toc-1";

/// One line an item: "9 2 range.front". nullopt unless every id from 0 to count - 1 is there once.
std::optional<std::vector<TocItem>> read_items(std::istream& file, std::uint16_t count) {
  std::string title;
  if (!(file >> title) || title != kTitle) return std::nullopt;
  std::vector<TocItem> items;
  unsigned id = 0;
  unsigned type = 0;
  std::string name;
  while (file >> id >> type >> name) {
    if (id != items.size() || type > 0xFF || name.find('.') == std::string::npos) return std::nullopt;
    items.push_back({static_cast<std::uint16_t>(id), static_cast<std::uint8_t>(type), name});
  }
  if (items.size() != count || !file.eof()) return std::nullopt;
  return items;
}

}  // namespace

std::filesystem::path TocCache::default_directory() {
  if (const char* own = std::getenv("CACHE_DIRECTORY"); own != nullptr && *own != '\0') return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg != '\0')
    return std::filesystem::path(xdg) / "swiftlet";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::filesystem::path(home) / ".cache" / "swiftlet";
  return {};
}

std::filesystem::path TocCache::file_of(std::uint8_t port, const TocInfo& info) const {
  std::array<char, 48> name{};
  std::snprintf(name.data(), name.size(), "toc_port%u_%u_%08X.txt", unsigned{port}, unsigned{info.count},
                unsigned{info.crc});
  return directory_ / name.data();
}

std::optional<std::vector<TocItem>> TocCache::load(std::uint8_t port, const TocInfo& info) {
  if (const auto known = known_.find(key_of(port, info)); known != known_.end()) return known->second;
  if (directory_.empty()) return std::nullopt;
  std::ifstream file(file_of(port, info));
  std::optional<std::vector<TocItem>> items = read_items(file, info.count);
  if (items) known_[key_of(port, info)] = *items;
  return items;
}

void TocCache::store(std::uint8_t port, const TocInfo& info, std::span<const TocItem> items) {
  known_[key_of(port, info)].assign(items.begin(), items.end());
  if (directory_.empty()) return;
  std::error_code ignored;
  std::filesystem::create_directories(directory_, ignored);
  // Under another name until it is complete: another swiftletd may read at the same time.
  const std::filesystem::path path = file_of(port, info);
  const std::filesystem::path unfinished = path.string() + ".new";
  {
    std::ofstream file(unfinished, std::ios::trunc);
    file << kTitle << '\n';
    for (const TocItem& item : items)
      file << item.id << ' ' << unsigned{item.type} << ' ' << item.name << '\n';
    if (!file.flush()) return;
  }
  std::filesystem::rename(unfinished, path, ignored);
}

void TocCache::forget(std::uint8_t port, const TocInfo& info) {
  known_.erase(key_of(port, info));
  std::error_code ignored;
  if (!directory_.empty()) std::filesystem::remove(file_of(port, info), ignored);
}

}  // namespace swiftlet
