// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/manual/shell_completion.hpp"

#include <algorithm>
#include <string_view>

namespace swiftlet {

namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, std::string_view between) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += between;
    out += word;
  }
  return out;
}

Words option_names(const CommandText& command) {
  Words names;
  for (const OptionText& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

Words command_names(const CommandText& program) {
  Words names;
  for (const CommandText& command : program.commands) names.push_back(command.name);
  return names;
}

bool is_file(const OptionText& option) {
  static constexpr std::string_view kNumbers[] = {"INT", "UINT", "FLOAT"};
  return option.choices.empty() &&
         std::find(std::begin(kNumbers), std::end(kNumbers), option.value) == std::end(kNumbers);
}

/// What bash offers for a value.
std::string bash_values(const OptionText& option) {
  if (!option.choices.empty())
    return R"(mapfile -t COMPREPLY < <(compgen -W ")" + joined(option.choices, " ") + R"(" -- "$cur"))";
  return is_file(option) ? ":" : "compopt +o default";
}

/// The cases of one command, or with an empty name of the program: a value behind an option that takes one.
std::string bash_value_cases(const CommandText& command, const std::string& name) {
  std::string out;
  for (const OptionText& option : command.options) {
    if (option.value.empty() || option.value_may_be_left_out) continue;
    Words patterns = option.names;
    for (std::string& pattern : patterns) pattern.insert(0, name + "/");
    out += "    " + joined(patterns, " | ") + ") " + bash_values(option) + "; return ;;\n";
  }
  return out;
}

std::string bash_word_case(const CommandText& command, const std::string& name) {
  Words first;
  for (const OptionText& argument : command.arguments)
    first.insert(first.end(), argument.choices.begin(), argument.choices.end());
  for (const CommandText& inner : command.commands) first.push_back(inner.name);
  return "    '" + name + "') options='" + joined(option_names(command), " ") + "'; words='" +
         joined(first, " ") + "' ;;\n";
}

std::string in_zsh_brackets(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string zsh_action(const OptionText& option) {
  if (!option.choices.empty()) return "(" + joined(option.choices, " ") + ")";
  return is_file(option) ? "_files" : " ";
}

/// One line of _arguments.
std::string zsh_option(const OptionText& option) {
  std::string out = "'(" + joined(option.names, " ") + ")'";
  if (option.may_be_repeated) out = "'*'";
  out += option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names.front();
  out += "'[" + in_zsh_brackets(option.description) + "]";
  if (!option.value.empty())
    out += std::string(option.value_may_be_left_out ? "::" : ":") + in_zsh_brackets(option.value) + ":" +
           zsh_action(option);
  return out + "'";
}

std::string zsh_argument(const OptionText& argument) {
  return std::string(argument.may_be_repeated ? "'*:"
                     : argument.is_required   ? "':"
                                              : "'::") +
         in_zsh_brackets(argument.names.front()) + ":" + zsh_action(argument) + "'";
}

std::string zsh_lines(const CommandText& command, const std::string& indent) {
  std::string out;
  for (const OptionText& option : command.options) out += " \\\n" + indent + zsh_option(option);
  for (const OptionText& argument : command.arguments) out += " \\\n" + indent + zsh_argument(argument);
  return out;
}

std::string zsh_command_list(const CommandText& program) {
  std::string out;
  for (const CommandText& command : program.commands)
    out += "        '" + command.name + ":" + in_zsh_brackets(command.description) + "'\n";
  return out;
}

/// Behind the program's own options.
std::string zsh_commands(const CommandText& program) {
  std::string cases;
  for (const CommandText& command : program.commands)
    cases += "        " + command.name + ")\n          _arguments -s" + zsh_lines(command, "            ") +
             "\n          ;;\n";
  return " \\\n    ':command:->command' '*::argument:->argument'\n"
         "  case $state in\n    command)\n      commands=(\n" +
         zsh_command_list(program) +
         "      )\n      _describe command commands\n      ;;\n    argument)\n      case $words[1] in\n" +
         cases + "      esac\n      ;;\n  esac\n";
}

}  // namespace

std::string bash_completion(const CommandText& program) {
  std::string values = bash_value_cases(program, "");
  std::string words = bash_word_case(program, "");
  for (const CommandText& command : program.commands) {
    values += bash_value_cases(command, command.name);
    words += bash_word_case(command, command.name);
  }
  const std::string function = "_" + program.name;
  const std::string commands = joined(command_names(program), " | ");
  std::string out = "# bash completion for " + program.name + "\n" + function +
                    "() {\n  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}\n"
                    "  local command='' options='' words=''\n  COMPREPLY=()\n";
  if (!commands.empty())
    out += "  if ((COMP_CWORD > 1)); then\n    case ${COMP_WORDS[1]} in " + commands +
           ") command=${COMP_WORDS[1]} ;; esac\n  fi\n";
  return out + "  case $command/$prev in\n" + values + "  esac\n  case $command in\n" + words +
         "  esac\n  if [[ $cur == -* ]]; then words=$options; fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$cur\")\n}\n"
         "complete -o default -F " +
         function + " " + program.name;
}

std::string zsh_completion(const CommandText& program) {
  return "#compdef " + program.name + "\n_" + program.name +
         "() {\n  local curcontext=$curcontext state line\n  local -a commands\n  _arguments -s -C" +
         zsh_lines(program, "    ") + (program.commands.empty() ? "\n" : zsh_commands(program)) + "}\n_" +
         program.name + " \"$@\"";
}

}  // namespace swiftlet
