// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/system_files.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = 65'536;
constexpr std::string_view kBlanks = " \t";

}  // namespace

fs::path SystemFiles::real(const std::string& path) const { return root_ / fs::path(path).relative_path(); }

bool SystemFiles::exists(const std::string& path) const {
  std::error_code error;
  return fs::exists(real(path), error);
}

std::optional<std::string> SystemFiles::read(const std::string& path) const {
  std::ifstream file(real(path), std::ios::binary);
  if (!file) return std::nullopt;
  std::string text(kMaxBytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::optional<long long> SystemFiles::read_number(const std::string& path) const {
  const std::optional<std::string> text = read(path);
  long long number = 0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), number).ec != std::errc{})
    return std::nullopt;
  return number;
}

std::vector<std::string> SystemFiles::names_in(const std::string& path) const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(real(path), error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> SystemFiles::target_of(const std::string& path) const {
  std::error_code error;
  const fs::path target = fs::read_symlink(real(path), error);
  return error ? std::nullopt : std::optional<std::string>(target);
}

std::optional<std::string> field_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.starts_with(key)) continue;
    line.remove_prefix(key.size());
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return std::string();
    return std::string(line.substr(first, line.find_last_not_of(kBlanks) - first + 1));
  }
  return std::nullopt;
}

}  // namespace swiftlet
