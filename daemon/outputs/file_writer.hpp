// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "core/base/result.hpp"

namespace swiftlet {

/// Creates the directory where it is missing and makes sure that files can be written there. Asked before a
/// run, so that hours of work do not end at a closed door. kInvalidInput: it cannot be.
[[nodiscard]] Status prepare_output_directory(const std::filesystem::path& directory);

/// Whether a file can be written: asked before the work, likewise. kInvalidInput: it has no name, is a
/// directory or one of the `inputs`, or there is no directory for it that can be written.
[[nodiscard]] Status check_output_file(const std::filesystem::path& file,
                                       std::span<const std::filesystem::path> inputs);

/// Writes the whole file under another name beside it, then renames it: whoever looks sees the old file or
/// the new one, never half of one. The other name is of no file that was there. A link is followed; a pipe or
/// a device is written to. kOutOfSpace: writing failed; the old file is untouched.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view bytes);

/// Takes the next bytes of a file. False: the disk takes no more, and the rest may be left out.
using FileSink = std::function<bool(std::string_view)>;
/// Hands a file's bytes to the sink, piece by piece. An error of its own means that there is no file.
using FileContent = std::function<Status(const FileSink& write)>;
/// The same for what is too long to be held at once.
[[nodiscard]] Status write_file(const std::filesystem::path& path, const FileContent& content);
/// The same for what cannot be had again: where writing fails, what was written stays under the other name,
/// which the error tells.
[[nodiscard]] Status record_file(const std::filesystem::path& path, const FileContent& content);

}  // namespace swiftlet
