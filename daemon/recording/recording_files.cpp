// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_files.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "daemon/system/utc_text.hpp"
#include "firmware_link/capture/capture_writer.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "swiftlet_";
constexpr std::string_view kSuffix = ".pcap";
constexpr std::string_view kTimeForm = "dddddddd_dddddd";  // d: a digit

/// nullopt when unset or empty.
std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it meanwhile
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Recording {
  std::string began;
  int part = 1;
  std::uint64_t bytes = 0;
  fs::path path;
};

/// Time and part from a file's name; nullopt when it is not a recording's.
std::optional<Recording> parse_name(std::string_view name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  if (name.size() < kPrefix.size() + kTimeForm.size() + kSuffix.size()) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  name.remove_suffix(kSuffix.size());
  const std::string_view began = name.substr(0, kTimeForm.size());
  const bool fits = std::ranges::equal(
      began, kTimeForm, [](char c, char form) { return form == 'd' ? is_digit(c) : c == form; });
  if (!fits) return std::nullopt;
  Recording recording;
  recording.began = began;
  const std::string_view part = name.substr(kTimeForm.size());
  if (part.empty()) return recording;
  if (part[0] != '_' || part.size() == 1 || !std::all_of(part.begin() + 1, part.end(), is_digit))
    return std::nullopt;
  const auto parsed = std::from_chars(part.data() + 1, part.data() + part.size(), recording.part);
  return parsed.ec == std::errc{} ? std::optional(recording) : std::nullopt;
}

/// The oldest first.
std::vector<Recording> recordings_in(const fs::path& directory) {
  std::vector<Recording> found;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    std::optional<Recording> recording = parse_name(entry->path().filename().string());
    std::error_code gone;
    if (!recording || entry->symlink_status(gone).type() != fs::file_type::regular) continue;
    recording->bytes = entry->file_size(gone);
    if (gone) continue;
    recording->path = entry->path();
    found.push_back(std::move(*recording));
  }
  std::ranges::sort(found, [](const Recording& a, const Recording& b) {
    return std::pair(a.began, a.part) < std::pair(b.began, b.part);
  });
  return found;
}

}  // namespace

Result<fs::path> default_recordings_directory() {
  if (const auto state = environment("STATE_DIRECTORY")) return fs::path(state->substr(0, state->find(':')));
  const fs::path own = fs::path("swiftlet") / "recordings";
  if (const auto state = environment("XDG_STATE_HOME")) return *state / own;
  if (const auto home = environment("HOME")) return fs::path(*home) / ".local" / "state" / own;
  return Error{ErrorCode::kNotFound,
               "no place for recordings: STATE_DIRECTORY, XDG_STATE_HOME and HOME are all unset; "
               "set record.directory, or use --record FILE or --no-record"};
}

std::string recording_name(HostTime began, int part) {
  std::string name = std::string(kPrefix) + utc_text(began, "%Y%m%d_%H%M%S");
  if (part > 1) name.append("_").append(std::to_string(part));
  return name + std::string(kSuffix);
}

std::string size_text(std::uint64_t bytes) {
  if (bytes < 10'000) return std::to_string(bytes) + " bytes";
  if (bytes < 10'000'000) return std::to_string(bytes / 1000) + " kB";
  return std::to_string(bytes / 1'000'000) + " MB";
}

std::vector<fs::path> remove_oldest_recordings(const fs::path& directory, std::uint64_t keep_bytes) {
  const std::vector<Recording> recordings = recordings_in(directory);
  std::uint64_t total = 0;
  for (const Recording& recording : recordings) total += recording.bytes;
  std::vector<fs::path> removed;
  for (const Recording& recording : recordings) {
    if (total <= keep_bytes) break;
    std::error_code error;
    if (is_being_written(recording.path.string()) || !fs::remove(recording.path, error)) continue;
    total -= recording.bytes;
    removed.push_back(recording.path);
  }
  return removed;
}

}  // namespace swiftlet
