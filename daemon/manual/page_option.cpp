// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/manual/page_option.hpp"

#include <algorithm>
#include <string>

#include "daemon/manual/manual_page.hpp"
#include "daemon/manual/shell_completion.hpp"

namespace swiftlet {

namespace {

std::vector<std::string> names_of(const CLI::Option& option, bool is_argument) {
  if (is_argument) return {option.get_name(true)};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());  // the set is in the order of addresses
  return names;
}

std::vector<std::string> choices_of(const std::string& name, const ManualFacts& facts) {
  const auto found = facts.choices.find(name);
  return found == facts.choices.end() ? std::vector<std::string>() : found->second;
}

OptionText option_text(const CLI::Option& option, bool is_argument, const ManualFacts& facts) {
  OptionText text;
  text.names = names_of(option, is_argument);
  if (option.get_items_expected_max() > 0) {
    const std::string type = option.get_type_name();  // "INT:INT in [2 - 64]" or "[ADDRESS:PORT]"
    text.value = type.substr(0, type.find(':', type.starts_with('[') ? type.find(']') : 0));
    if (text.value.size() < type.size()) text.limits = type.substr(text.value.size() + 1);
  }
  text.value_may_be_left_out = option.get_items_expected_min() == 0;
  text.may_be_repeated = option.get_items_expected_max() > 1;
  text.is_required = option.get_required();
  text.default_value = option.get_default_str();
  text.environment = option.get_envname();
  text.excludes = names_of(option.get_excludes());
  text.needs = names_of(option.get_needs());
  text.description = option.get_description();
  text.choices = choices_of(text.names.back(), facts);
  return text;
}

/// Of "PROGRAM: what it does" what it does.
std::string without_name(const std::string& name, const std::string& description) {
  const std::string prefix = name + ": ";
  return description.starts_with(prefix) ? description.substr(prefix.size()) : description;
}

std::string page(const CLI::App& app, const ManualFacts& facts, const std::string& kind) {
  const CommandText text = command_text(app, facts);
  if (kind == "man") return manual_page(text, facts);
  return kind == "bash" ? bash_completion(text) : zsh_completion(text);
}

}  // namespace

CommandText command_text(const CLI::App& app, const ManualFacts& facts) {
  CommandText text{.name = app.get_name(),
                   .description = without_name(app.get_name(), app.get_description()),
                   .footer = app.get_footer(),
                   .arguments = {},
                   .options = {},
                   .commands = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    if (option->get_positional()) text.arguments.push_back(option_text(*option, true, facts));
    if (option->nonpositional()) text.options.push_back(option_text(*option, false, facts));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    text.commands.push_back(command_text(*command, facts));
  return text;
}

void add_page_option(CLI::App& app, const ManualFacts& facts) {
  const auto print = [&app, facts](const std::string& kind) {
    throw CLI::CallForVersion(page(app, facts, kind), 0);  // what answer() prints, without asking for more
  };
  app.add_option_function<std::string>("--print-page", print)
      ->check(CLI::IsMember({"man", "bash", "zsh"}))
      ->group("");
}

}  // namespace swiftlet
