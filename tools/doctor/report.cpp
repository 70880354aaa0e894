// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace swiftlet {
namespace {

const char* colour_of(Mark mark) {
  switch (mark) {
    case Mark::kOk:
      return "\033[32m";
    case Mark::kWarning:
      return "\033[33m";
    case Mark::kProblem:
      return "\033[1;31m";
    case Mark::kSkipped:
      break;
  }
  return "\033[2m";
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string line_of(const Finding& finding, std::size_t name_width, bool colours) {
  std::string line = padded(text_of(finding.mark), 7);
  if (colours) line = colour_of(finding.mark) + line + "\033[0m";
  line += "  " + padded(finding.check, name_width) + "  " + finding.found;
  if (!finding.remedy.empty()) line += " -> " + finding.remedy;
  return line + '\n';
}

/// Neighbours that were skipped for the same reason in one line.
Findings folded(const Findings& findings) {
  Findings lines;
  std::string reason;  // of the skipped one before
  for (const Finding& finding : findings) {
    const bool is_skipped = finding.mark == Mark::kSkipped;
    if (is_skipped && !reason.empty() && finding.found == reason) {
      Finding& line = lines.back();
      line.found += (line.found == reason ? "; likewise " : ", ") + finding.check;
      continue;
    }
    lines.push_back(finding);
    reason = is_skipped ? finding.found : "";
  }
  return lines;
}

std::string counted(std::size_t number, const std::string& what) {
  return std::to_string(number) + ' ' + what + (number == 1 ? "" : "s");
}

}  // namespace

const char* text_of(Mark mark) {
  switch (mark) {
    case Mark::kOk:
      return "ok";
    case Mark::kWarning:
      return "warning";
    case Mark::kProblem:
      return "problem";
    case Mark::kSkipped:
      break;
  }
  return "skipped";
}

std::size_t count(const Findings& findings, Mark mark) {
  return static_cast<std::size_t>(std::count_if(
      findings.begin(), findings.end(), [mark](const Finding& finding) { return finding.mark == mark; }));
}

std::string report_text(const Findings& findings, bool colours) {
  std::size_t name_width = 0;
  for (const Finding& finding : findings) name_width = std::max(name_width, finding.check.size());
  std::string text;
  for (const Finding& finding : folded(findings)) text += line_of(finding, name_width, colours);
  const std::size_t problems = count(findings, Mark::kProblem);
  return text + '\n' + counted(problems, "problem") + ", " +
         counted(count(findings, Mark::kWarning), "warning") +
         (problems == 0 ? ": nothing stops a flight\n"
                        : ": not ready; solve the first problem first, then ask again\n");
}

std::string report_json(const std::string& input, const Findings& findings) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const Finding& finding : findings)
    checks.push_back({{"check", finding.check},
                      {"mark", text_of(finding.mark)},
                      {"found", finding.found},
                      {"remedy", finding.remedy}});
  const nlohmann::ordered_json report{
      {"input", input}, {"ready", count(findings, Mark::kProblem) == 0}, {"checks", checks}};
  // A text that a device sent may hold anything.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace swiftlet
