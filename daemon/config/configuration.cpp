// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/configuration.hpp"

#include <algorithm>
#include <cstddef>

namespace swiftlet {
namespace {

constexpr std::size_t kMaxPrefix = 40;  // LCM allows 63 characters for a whole channel name

bool is_channel_name(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
  });
}

}  // namespace

std::vector<std::string> PublishConfig::validate() const {
  std::vector<std::string> problems = setting_problems(*this);
  if (channel_prefix.size() > kMaxPrefix || !is_channel_name(channel_prefix))
    problems.push_back("publish.channel_prefix = \"" + channel_prefix + "\": at most " +
                       std::to_string(kMaxPrefix) + " letters, digits and _ - . /");
  return problems;
}

std::vector<std::string> RecordConfig::validate() const {
  std::vector<std::string> problems = setting_problems(*this);
  if (problems.empty() && max_total_mb < max_file_mb)
    problems.emplace_back("record.max_total_mb must not be less than record.max_file_mb");
  return problems;
}

std::vector<std::string> Configuration::validate() const {
  std::vector<std::string> problems;
  for_each_section(*this, [&problems](const auto& section) {
    const std::vector<std::string> more = section.validate();
    problems.insert(problems.end(), more.begin(), more.end());
  });
  return problems;
}

}  // namespace swiftlet
