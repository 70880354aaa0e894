// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/fmt/fmt.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <system_error>

#include "daemon/config/configuration.hpp"
#include "daemon/config/tuning_range.hpp"

namespace swiftlet {
namespace {

template <typename T>
bool assign_exactly(const toml::node& node, T& value) {
  const std::optional<T> exact = node.value_exact<T>();
  if (exact) value = *exact;
  return exact.has_value();
}
template <typename Real>
bool assign_number(const toml::node& node, Real& value) {
  // value<double>() is empty for whole numbers beyond 2^53; their last digits do not matter here.
  if (const std::optional<std::int64_t> whole = node.value_exact<std::int64_t>()) {
    value = static_cast<double>(*whole);
    return true;
  }
  const std::optional<double> real = node.value_exact<double>();
  if (real) value = *real;
  return real.has_value();
}

// Put a TOML value into a setting; false when it is of another type. Whole numbers may stand for real ones.
bool assign(const toml::node& node, bool& value) { return assign_exactly(node, value); }
bool assign(const toml::node& node, std::string& value) { return assign_exactly(node, value); }
bool assign(const toml::node& node, double& value) { return assign_number(node, value); }
bool assign(const toml::node& node, std::optional<double>& value) { return assign_number(node, value); }
bool assign(const toml::node& node, int& value) {
  std::int64_t number = 0;
  if (!assign_exactly(node, number)) return false;
  // Beyond int is beyond every setting's range too, and is reported as that.
  value = static_cast<int>(
      std::clamp<std::int64_t>(number, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
  return true;
}

bool assign(const toml::node& node, std::size_t& value) {
  std::int64_t number = 0;
  if (!assign_exactly(node, number) || number < 0) return false;
  value = static_cast<std::size_t>(number);
  return true;
}

std::string_view expected_value(const bool&) { return "true or false"; }
std::string_view expected_value(const int&) { return "a whole number"; }
std::string_view expected_value(const std::size_t&) { return "a whole number, not negative"; }
std::string_view expected_value(const double&) { return "a number"; }
std::string_view expected_value(const std::optional<double>&) { return "a number"; }
std::string_view expected_value(const std::string&) { return "a text in quotes"; }

/// Empty, or what is wrong.
template <typename Value>
std::string tuning_problem(std::string_view part, std::string_view key, const Value& value,
                           const Value& default_value) {
  const TuningRange range = tuning_range(key, default_value);
  const auto number = static_cast<double>(value);
  if (number >= range.lowest && number <= range.highest) return {};
  return fmt::format("tuning.{}.{} = {}: must lie between {} and {}", part, key, shortest_text(number),
                     shortest_text(range.lowest), shortest_text(range.highest));
}

/// Reads a file, and settings above it, into one configuration, and collects all problems.
class Loader {
 public:
  Status read_file(const std::string& path) {
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(path, failure);
    if (std::filesystem::is_directory(status))
      return Error{ErrorCode::kInvalidInput, path + ": is a directory; name the TOML file in it"};
    if (status.type() == std::filesystem::file_type::none)
      return Error{ErrorCode::kInvalidInput, path + ": cannot be looked up: " + failure.message() +
                                                 "; correct its path or the permissions of its folders"};
    if (!std::filesystem::is_regular_file(status))
      return Error{ErrorCode::kNotFound, path + ": no such configuration file"};
    source_ = path;
    has_lines_ = true;
    read([&] { return toml::parse_file(path); });
    return {};
  }
  void read_settings(const std::string& toml_text) {
    source_ = "settings";
    has_lines_ = false;
    read([&] { return toml::parse(toml_text); });
  }

  Result<Configuration> result() {
    if (problems_.empty()) {
      for (const std::string& problem : config_.validate()) note_of_whole(problem);
    }
    if (problems_.empty()) return config_;
    return Error{ErrorCode::kInvalidInput, all_problems()};
  }

 private:
  std::string source_ = "configuration";
  bool has_lines_ = false;
  Configuration config_;
  std::vector<std::pair<toml::source_index, std::string>> problems_;  // with their lines
  std::map<std::string, std::pair<toml::source_index, std::string>, std::less<>>
      places_;  // line and prefix of "section.key"

  template <typename Parse>
  void read(const Parse& parse) {
    try {
      read_sections(parse());
    } catch (const toml::parse_error& error) {
      note(error.source(), error.description());
    }
  }

  [[nodiscard]] std::pair<toml::source_index, std::string> place(const toml::source_region& where) const {
    if (!has_lines_) return {0, source_ + ": "};
    return {where.begin.line, fmt::format("{}:{}: ", source_, where.begin.line)};
  }
  void note(const toml::source_region& where, std::string_view what) {
    auto [line, prefix] = place(where);
    problems_.emplace_back(line, prefix.append(what));
  }

  /// Begins with "section.key"; with its line where the file has that key.
  void note_of_whole(std::string_view problem) {
    const auto found = places_.find(problem.substr(0, problem.find(' ')));
    auto [line, prefix] = found != places_.end() ? found->second : std::pair(0U, source_ + ": ");
    problems_.emplace_back(line, prefix.append(problem));
  }

  void read_sections(const toml::table& file) {
    for (const auto& [name, node] : file) {
      const toml::table* table = node.as_table();
      if (table != nullptr && name == "tuning") {
        read_tuning(*table);
        continue;
      }
      if (table != nullptr && read_section(name.str(), *table)) continue;
      note(name.source(), fmt::format("unknown {} \"{}\"; docs/configuration.md lists them all",
                                      table == nullptr ? "key" : "section", name.str()));
    }
  }

  /// False where there is no such section.
  bool read_section(std::string_view name, const toml::table& table) {
    bool is_known = false;
    for_each_section(config_, [&](auto& section) {
      if (section.kSection.name != name) return;
      is_known = true;
      for (const auto& [key, node] : table) read_key(section, key, node);
    });
    return is_known;
  }

  void read_tuning(const toml::table& parts) {
    for (const auto& [name, node] : parts) {
      const toml::table* table = node.as_table();
      if (table == nullptr || !read_tuning_part(name.str(), *table))
        note(name.source(), fmt::format("unknown section \"tuning.{}\"", name.str()));
    }
  }

  /// False where there is no such part.
  bool read_tuning_part(std::string_view name, const toml::table& table) {
    bool is_known = false;
    for_each_tuning(config_, [&](std::string_view part, auto& tuning) {
      if (part != name) return;
      is_known = true;
      for (const auto& [key, node] : table) read_tuning_value(part, tuning, key, node);
    });
    return is_known;
  }

  template <typename Tuning>
  void read_tuning_value(std::string_view part, Tuning& tuning, const toml::key& key,
                         const toml::node& node) {
    const std::string name = fmt::format("tuning.{}.{}", part, key.str());
    const auto* value = std::ranges::find(Tuning::kValues, key.str(), &TuningValue<Tuning>::name);
    if (value == std::end(Tuning::kValues))
      return note(key.source(), fmt::format("unknown key \"{}\"", name));
    const auto read = [&](auto member) -> std::string {
      if (assign(node, tuning.*member))
        return tuning_problem(part, key.str(), tuning.*member, Tuning{}.*member);
      return fmt::format("{} must be {}", name, expected_value(tuning.*member));
    };
    if (const std::string problem = std::visit(read, value->member); !problem.empty())
      note(key.source(), problem);
  }

  template <typename Section>
  void read_key(Section& section, const toml::key& key, const toml::node& node) {
    const std::string name = fmt::format("{}.{}", section.kSection.name, key.str());
    const auto* setting = std::ranges::find(Section::kSettings, key.str(), &Setting<Section>::key);
    if (setting == std::end(Section::kSettings))
      return note(key.source(),
                  fmt::format("unknown key \"{}\"; docs/configuration.md lists them all", name));
    places_.insert_or_assign(name, place(key.source()));
    const auto read = [&](auto member) -> std::string {
      if (assign(node, section.*member)) return setting_problem(section, *setting);
      return fmt::format("{} must be {}", name, expected_value(section.*member));
    };
    if (const std::string problem = std::visit(read, setting->member); !problem.empty())
      note(key.source(), problem);
  }

  std::string all_problems() {
    std::stable_sort(problems_.begin(), problems_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string line;
    for (const auto& [at, problem] : problems_) line += (line.empty() ? "" : "; ") + problem;
    return line;
  }
};

}  // namespace

Result<Configuration> load_configuration(const std::string& path, const std::string& settings) {
  Loader loader;
  if (!path.empty())
    if (Status read = loader.read_file(path); !read) return read.error();
  if (!settings.empty()) loader.read_settings(settings);
  return loader.result();
}

}  // namespace swiftlet
