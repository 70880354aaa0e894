// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/flights_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <vector>

#include "daemon/outputs/report_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Flight {
  double length_m = 0.0;
  double duration_s = 0.0;
  int closures = 0;  ///< that were kept
};

/// nullopt where the folder has no report, or one of something else.
std::optional<Flight> flight_in(const fs::path& folder) {
  const Result<Json> report = read_report(folder / "report.json");
  if (!report || report->is_discarded()) return std::nullopt;
  try {
    const Json& closures = report->at("backend").at("closures");
    return Flight{.length_m = report->at("trajectory").at("odometry_length_m"),
                  .duration_s = report->at("trajectory").at("duration_s"),
                  .closures = closures.at("accepted").get<int>() - closures.at("dropped").get<int>()};
  } catch (const Json::exception&) {  // something is missing or of another type
    return std::nullopt;
  }
}

std::string duration_text(double duration_s) {
  const auto seconds = static_cast<long>(std::lround(duration_s));
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

/// Nothing for what is no flight.
std::optional<std::string> line_of(const fs::path& folder, std::size_t width) {
  const std::string name = folder.filename().string();
  if (const std::optional<Flight> flight = flight_in(folder))
    return fmt::format("{:<{}} {:>9.1f} {:>9} {:>9}  {}", name, width, flight->length_m,
                       duration_text(flight->duration_s), flight->closures,
                       (folder / "thumbnail.png").string());
  if (is_being_written_to(folder)) return fmt::format("{:<{}} is under way", name, width);
  return std::nullopt;
}

Result<std::vector<fs::path>> folders_in(const fs::path& directory) {
  std::vector<fs::path> folders;
  std::error_code failure;
  for (fs::directory_iterator entry(directory, failure), end; !failure && entry != end;
       entry.increment(failure))
    folders.push_back(entry->path());
  if (failure)
    return Error{ErrorCode::kNotFound,
                 directory.string() + ": " + failure.message() +
                     "; without -o, swiftlet map and swiftletd make a folder for each flight in " +
                     kFlightsDirectory};
  std::ranges::sort(folders);
  return folders;
}

}  // namespace

Status run_flights_command(const FlightsCommand& command) {
  const Result<std::vector<fs::path>> folders = folders_in(command.directory);
  if (!folders) return folders.error();
  std::size_t width = 0;
  for (const fs::path& folder : *folders) width = std::max(width, folder.filename().string().size());
  fmt::print("{:<{}} {:>9} {:>9} {:>9}  {}\n", "flight", width, "length, m", "duration", "closures",
             "thumbnail");
  for (const fs::path& folder : *folders)
    if (const std::optional<std::string> line = line_of(folder, width)) fmt::print("{}\n", *line);
  return {};
}

}  // namespace swiftlet
