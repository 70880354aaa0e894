// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/manual/manual_page.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace swiftlet {

namespace {

/// As text of roff: no character has a meaning of its own, and every hyphen can be copied into a shell.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '~')
      out += "\\(ti";
    else
      out += c;
  }
  return out;
}

/// A paragraph of one or several lines, none of which is taken for a request.
std::string paragraph(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line.empty()) continue;
    if (!out.empty()) out += ".br\n";
    if (line.starts_with('.')) out += "\\&";
    out.append(escaped(line)).append("\n");
  }
  return out;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }

std::string joined_in_bold(const std::vector<std::string>& words, std::string_view between) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += between;
    out += bold(word);
  }
  return out;
}

std::string value_of(const OptionText& option) {
  if (option.value.empty()) return {};
  const bool has_brackets = option.value_may_be_left_out && !option.value.starts_with('[');
  return " \\fI" + escaped(has_brackets ? "[" + option.value + "]" : option.value) + "\\fR";
}

/// What stands behind the description.
std::string notes_of(const OptionText& option) {
  std::string out;
  const auto note = [&out](const std::string& text) { out.append(text).append(".\n"); };
  if (option.is_required) note("Required");
  if (!option.limits.empty()) note("Takes " + escaped(option.limits));
  if (!option.choices.empty()) note("One of " + joined_in_bold(option.choices, ", "));
  if (option.may_be_repeated) note("May be given several times");
  if (!option.default_value.empty()) note("Default: " + bold(option.default_value));
  if (!option.environment.empty()) note("Also set by the environment's " + bold(option.environment));
  if (!option.needs.empty()) note("Only with " + joined_in_bold(option.needs, ", "));
  if (!option.excludes.empty()) note("Not with " + joined_in_bold(option.excludes, ", "));
  return out;
}

std::string entry(const OptionText& option, bool is_argument) {
  std::string description = paragraph(option.description);
  const std::string notes = notes_of(option);
  if (!notes.empty() && !description.empty() && description.ends_with("\n"))
    description.insert(description.size() - 1, ".");
  return ".TP\n" + joined_in_bold(option.names, ", ") + (is_argument ? "" : value_of(option)) + "\n" +
         description + notes;
}

std::string entries(const CommandText& command) {
  std::string out;
  for (const OptionText& argument : command.arguments) out += entry(argument, true);
  for (const OptionText& option : command.options) out += entry(option, false);
  return out;
}

std::string footer(const CommandText& command) {
  return command.footer.empty() ? "" : ".PP\n" + paragraph(command.footer);
}

std::string command_section(const std::string& program, const CommandText& command) {
  return ".SS " + bold(program + " " + command.name) + " " + escaped(synopsis_of(command)) + "\n" +
         paragraph(command.description + ".") + entries(command) + footer(command);
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string synopsis_section(const CommandText& program) {
  std::string out = ".SH SYNOPSIS\n" + bold(program.name) + " " + escaped(synopsis_of(program)) + "\n";
  for (const CommandText& command : program.commands)
    out += ".br\n" + bold(program.name + " " + command.name) + " " + escaped(synopsis_of(command)) + "\n";
  return out;
}

}  // namespace

std::string synopsis_of(const CommandText& command) {
  std::string out = "[OPTION]...";
  for (const OptionText& argument : command.arguments) {
    const std::string name = argument.names.front() + (argument.may_be_repeated ? "..." : "");
    out += argument.is_required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) out += " COMMAND";
  return out;
}

std::string manual_page(const CommandText& program, const ManualFacts& facts) {
  std::string out = ".TH " + upper_case(program.name) + " " + std::to_string(facts.section) + " \"\" \"" +
                    escaped(facts.version.substr(0, facts.version.find(" ("))) +
                    "\"\n.nh\n.ad l\n.SH NAME\n" + escaped(program.name) + " \\- " +
                    escaped(program.description) + "\n" + synopsis_section(program) + ".SH OPTIONS\n" +
                    entries(program) + footer(program);
  if (!program.commands.empty()) out += ".SH COMMANDS\n";
  for (const CommandText& command : program.commands) out += command_section(program.name, command);
  for (const auto& [title, text] : facts.sections) out += ".SH \"" + title + "\"\n" + paragraph(text);
  out.pop_back();
  return out;
}

}  // namespace swiftlet
