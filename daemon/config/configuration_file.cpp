// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <spdlog/fmt/fmt.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include "daemon/config/configuration.hpp"
#include "daemon/config/configuration_fields.hpp"

namespace swiftlet {
namespace {

/// Puts a TOML value into a field; false when it is of another type. Whole numbers may stand for real ones.
struct Assign {
  const toml::node& value;

  bool operator()(bool* field) const { return take<bool>(field); }
  bool operator()(std::string* field) const { return take<std::string>(field); }
  bool operator()(double* field) const { return take_number(field); }
  bool operator()(std::optional<double>* field) const { return take_number(field); }
  bool operator()(int* field) const {
    const std::optional<std::int64_t> number = value.value_exact<std::int64_t>();
    if (!number) return false;
    // Beyond int is beyond every field's bounds too, and is reported as that.
    *field = static_cast<int>(
        std::clamp<std::int64_t>(*number, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    return true;
  }

 private:
  template <typename T, typename Field>
  bool take(Field* field) const {
    const std::optional<T> exact = value.value_exact<T>();
    if (exact) *field = *exact;
    return exact.has_value();
  }
  template <typename Field>
  bool take_number(Field* field) const {
    if (!value.is_number()) return false;
    *field = *value.value<double>();
    return true;
  }
};

struct TypeName {
  std::string_view operator()(const bool*) const { return "true or false"; }
  std::string_view operator()(const int*) const { return "a whole number"; }
  std::string_view operator()(const double*) const { return "a number"; }
  std::string_view operator()(const std::optional<double>*) const { return "a number"; }
  std::string_view operator()(const std::string*) const { return "a text in quotes"; }
};

/// Reads one file into one configuration and remembers all that is wrong with it.
class Loader {
 public:
  explicit Loader(const std::string& path) : path_(path) {}

  Result<Configuration> load() {
    if (!std::filesystem::is_regular_file(path_))
      return Error{ErrorCode::kNotFound, path_ + ": no such configuration file"};
    try {
      read_sections(toml::parse_file(path_));
    } catch (const toml::parse_error& error) {
      note(error.source(), error.description());
    }
    if (problems_.empty()) {
      for (const std::string& problem : config_.validate()) note_of_whole(problem);
    }
    if (problems_.empty()) return config_;
    return Error{ErrorCode::kInvalidInput, all_problems()};
  }

 private:
  std::string path_;
  Configuration config_;
  std::vector<std::pair<toml::source_index, std::string>> problems_;  // with their lines
  std::map<std::string, toml::source_region, std::less<>> regions_;   // of "section.key"

  void note(const toml::source_region& where, std::string_view what) {
    problems_.emplace_back(where.begin.line, fmt::format("{}:{}: {}", path_, where.begin.line, what));
  }

  /// Begins with "section.key"; the line is told where the file has that key.
  void note_of_whole(std::string_view problem) {
    const auto region = regions_.find(problem.substr(0, problem.find(' ')));
    if (region != regions_.end()) return note(region->second, problem);
    problems_.emplace_back(0, fmt::format("{}: {}", path_, problem));
  }

  void read_sections(const toml::table& file) {
    for (const auto& [name, node] : file) {
      const std::string_view section = name.str();
      if (const toml::table* table = node.as_table(); table != nullptr && is_section(section)) {
        for (const auto& [key, value] : *table) read_key(section, key, value);
      } else {
        note(name.source(), fmt::format("unknown {} \"{}\"; docs/configuration.md lists them all",
                                        table == nullptr ? "key" : "section", section));
      }
    }
  }

  void read_key(std::string_view section, const toml::key& key, const toml::node& value) {
    for (const ConfigurationField& field : configuration_fields()) {
      if (field.section != section || field.key != key.str()) continue;
      regions_.emplace(fmt::format("{}.{}", section, field.key), key.source());
      const FieldPointer target = field.in(config_);
      if (!std::visit(Assign{value}, target)) {
        note(key.source(),
             fmt::format("{}.{} must be {}", section, field.key, std::visit(TypeName{}, target)));
      } else if (const std::string problem = field_problem(field, config_); !problem.empty()) {
        note(key.source(), problem);
      }
      return;
    }
    note(key.source(),
         fmt::format("unknown key \"{}.{}\"; docs/configuration.md lists them all", section, key.str()));
  }

  static bool is_section(std::string_view name) {
    const auto fields = configuration_fields();
    return std::any_of(fields.begin(), fields.end(),
                       [&](const auto& field) { return field.section == name; });
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

Result<Configuration> load_configuration(const std::string& path) { return Loader(path).load(); }

}  // namespace swiftlet
