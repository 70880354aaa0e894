// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/numbered_path.hpp"

#include <filesystem>
#include <system_error>

#include "core/base/result.hpp"
#include "daemon/publish/lcm_url.hpp"

namespace swiftlet {
namespace {

/// Without a slash at its end, and with a name: not "." or "..".
std::filesystem::path named_path(const std::string& path) {
  std::filesystem::path named = std::filesystem::path(path).lexically_normal();
  std::error_code ignored;
  if (named == "." || named.filename() == "..")
    named = std::filesystem::absolute(named, ignored).lexically_normal();
  return named.has_filename() ? named : named.parent_path();
}

}  // namespace

std::string numbered_path(const std::string& path, int number) {
  const std::filesystem::path first = named_path(path);
  const std::string name = first.stem().string() + "_" + std::to_string(number) + first.extension().string();
  return (first.parent_path() / name).string();
}

std::string numbered_lcm_url(const std::string& url, int number) {
  const Result<LcmUrl> parsed = parse_lcm_url(url);
  std::error_code ignored;
  const bool is_log = parsed && !parsed->file.empty() && url.find("mode=w") != std::string::npos;
  if (!is_log || !std::filesystem::is_regular_file(parsed->file, ignored)) return url;
  std::string numbered = url;
  return numbered.replace(url.rfind(parsed->file, url.find('?')), parsed->file.size(),
                          numbered_path(parsed->file, number));
}

}  // namespace swiftlet
