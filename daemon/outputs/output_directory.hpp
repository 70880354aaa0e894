// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <dirent.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// Holds the folders of runs whose user named no directory; below the working directory.
inline constexpr const char* kFlightsDirectory = "flights";

/// "2026-11-22_1512_office": the minute (UTC) in which a run began, and the name of its input: the world of a
/// simulation, the name of a file up to its first dot, else the URI. Holds letters, digits, '-', '.' and '_'.
[[nodiscard]] std::string flight_folder_name(const std::string& input, HostTime began);

/// Where a run writes its outputs: a directory that no other run writes to while this lives. What was
/// made for the run and got no file is removed at the end, with the folders above it.
class OutputDirectory {
 public:
  /// The directory that the user named, made where missing. kInvalidInput: it has no name, cannot be written,
  /// or another run writes there.
  [[nodiscard]] static Result<OutputDirectory> open(const std::filesystem::path& directory);
  /// A new folder of this name in `parent`, which is made where missing; where the name is taken, followed by
  /// _2, _3 and so on. kInvalidInput: none could be made.
  [[nodiscard]] static Result<OutputDirectory> make(const std::filesystem::path& parent,
                                                    const std::string& name);
  /// The one that the user named, else a new one in kFlightsDirectory. Errors: as above.
  [[nodiscard]] static Result<OutputDirectory> of_run(const std::optional<std::string>& named,
                                                      const std::string& input, HostTime began);
  ~OutputDirectory();
  OutputDirectory(OutputDirectory&&) = default;
  OutputDirectory& operator=(OutputDirectory&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct Close {
    void operator()(DIR* directory) const { static_cast<void>(::closedir(directory)); }
  };
  explicit OutputDirectory(std::filesystem::path path) : path_(std::move(path)) {}
  [[nodiscard]] Status hold();

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // for this run, the innermost first
  std::unique_ptr<DIR, Close> held_;         // locked
};

/// Whether a run writes to the directory.
[[nodiscard]] bool is_being_written_to(const std::filesystem::path& directory);

}  // namespace swiftlet
