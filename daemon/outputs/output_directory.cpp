// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/output_directory.hpp"

#include <sys/file.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "daemon/outputs/file_writer.hpp"
#include "daemon/system/utc_text.hpp"
#include "firmware_link/input/input_uri.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameSize = 60;
constexpr int kMaxFolders = 10'000;  // of one name

std::string name_of(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  if (const InputFile* file = uri ? uri->as<InputFile>() : nullptr) {
    const std::string name = fs::path(file->path).filename().string();
    return name.substr(0, name.find('.'));
  }
  const std::size_t start = uri && uri->is(InputNature::kSimulation) ? uri->kind->scheme.size() : 0;
  return input.substr(start, input.find('?') - start);
}

bool may_stay(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

/// What may not stand in a folder's name becomes one '_'.
std::string tidied(const std::string& name) {
  std::string tidy;
  for (const char c : name.substr(0, kMaxNameSize)) {
    if (may_stay(c))
      tidy += c;
    else if (!tidy.ends_with('_'))
      tidy += '_';
  }
  return tidy;
}

/// The directory and those above it that are not there, the innermost first.
std::vector<fs::path> missing_folders(const fs::path& directory) {
  std::vector<fs::path> missing;
  std::error_code unknown;
  for (fs::path at = directory; !at.empty() && !fs::exists(at, unknown) && !unknown; at = at.parent_path())
    missing.push_back(at);
  return missing;
}

}  // namespace

std::string flight_folder_name(const std::string& input, HostTime began) {
  const std::string name = tidied(name_of(input));
  return utc_text(began, "%Y-%m-%d_%H%M_") + (name.empty() ? "flight" : name);
}

Result<OutputDirectory> OutputDirectory::open(const fs::path& directory) {
  if (directory.empty())
    return Error{ErrorCode::kInvalidInput, "-o names no directory; leave it out for a folder of its own"};
  std::vector<fs::path> missing = missing_folders(directory);
  if (Status ready = prepare_output_directory(directory); !ready) return ready.error();
  OutputDirectory output(directory);
  output.made_ = std::move(missing);
  if (Status held = output.hold(); !held) return held.error();
  return output;
}

Result<OutputDirectory> OutputDirectory::make(const fs::path& parent, const std::string& name) {
  OutputDirectory output(parent / name);
  std::error_code unknown;
  const bool parent_is_new = !fs::exists(parent, unknown) && !unknown;
  for (int number = 2; number <= kMaxFolders; ++number) {
    if (Status ready = prepare_output_directory(parent); !ready) return ready.error();
    std::error_code failure;
    if (fs::create_directory(output.path_, failure)) {
      output.made_ = {output.path_};
      if (parent_is_new) output.made_.push_back(parent);
      if (Status held = output.hold(); !held) return held.error();
      return output;
    }
    output.path_ = parent / (name + "_" + std::to_string(number));
  }
  return Error{ErrorCode::kInvalidInput,
               "no folder " + (parent / name).string() + " could be made; name a directory with -o"};
}

Result<OutputDirectory> OutputDirectory::of_run(const std::optional<std::string>& named,
                                                const std::string& input, HostTime began) {
  if (named) return open(*named);
  return make(kFlightsDirectory, flight_folder_name(input, began));
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  for (const fs::path& directory : made_) fs::remove(directory, ignored);  // unless it holds something
}

Status OutputDirectory::hold() {
  held_.reset(::opendir(path_.c_str()));
  // A file system without locks does not keep a run from its outputs.
  if (!held_ || ::flock(::dirfd(held_.get()), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
  made_.clear();
  return Error{ErrorCode::kInvalidInput, "output directory " + path_.string() +
                                             ": another run writes there; wait for its end or name another"};
}

bool is_being_written_to(const fs::path& directory) {
  const std::unique_ptr<DIR, int (*)(DIR*)> looked(::opendir(directory.c_str()), ::closedir);
  return looked && ::flock(::dirfd(looked.get()), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace swiftlet
