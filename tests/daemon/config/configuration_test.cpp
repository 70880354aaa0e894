// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/checkout.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A file that lives as long as the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(std::filesystem::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml")) {
    std::ofstream(path_) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string refusal_of(const std::string& content) {
  const TemporaryFile file(content);
  const Result<Configuration> config = load_configuration(file.path());
  return config ? "accepted" : config.error().message;
}

// Fields of an aggregate, counted by how many initialisers it takes.
struct Anything {
  template <typename T>
  operator T() const;  // NOLINT(*-explicit-*)
};
template <typename T, typename... Initialisers>
consteval std::size_t field_count() {
  if constexpr (requires { T{Initialisers{}..., Anything{}}; }) {
    return field_count<T, Initialisers..., Anything>();
  } else {
    return sizeof...(Initialisers);
  }
}

std::string shipped_file() { return checkout() / "daemon/config/swiftletd.toml"; }

/// Calls visit(section, setting) for each setting of `config`.
template <typename Visitor>
void for_each_setting(const Configuration& config, Visitor visit) {
  for_each_section(config, [&visit](const auto& section) {
    for (const auto& setting : section.kSettings) visit(section, setting);
  });
}

template <typename Section>
std::string name_of(const Setting<Section>& setting) {
  return std::string(Section::kSection.name) + "." + std::string(setting.key);
}

TEST(ConfigurationTables, HoldEveryMemberOfEverySection) {
  for_each_section(Configuration(), [](const auto& section) {
    using Section = std::remove_cvref_t<decltype(section)>;
    if constexpr (std::is_same_v<Section, SensorOverrides>) {
      EXPECT_EQ(std::size(Section::kSettings), sizeof(Section) / sizeof(std::optional<double>));
    } else {  // an algorithm's tuning is no setting
      constexpr bool kHasTuning = requires(Section s) { s.tuning; };
      EXPECT_EQ(std::size(Section::kSettings) + (kHasTuning ? 1 : 0), field_count<Section>())
          << Section::kSection.name;
    }
  });
}

TEST(TuningTables, HoldEveryValueOfEveryStruct) {
  std::size_t parts = 0;
  for_each_tuning(Configuration(), [&parts](std::string_view part, const auto& tuning) {
    using Tuning = std::remove_cvref_t<decltype(tuning)>;
    constexpr bool kHasPart = requires(Tuning t) { t.walls; };
    EXPECT_EQ(std::size(Tuning::kValues) + (kHasPart ? 1 : 0), field_count<Tuning>()) << part;
    parts += 1 - (kHasPart ? 1 : 0);
  });
  EXPECT_EQ(parts, field_count<FrontendTuning>() + field_count<BackendTuning>() + field_count<MapTuning>());
}

TEST(TuningTables, EachValueIsSetByItsName) {
  Configuration changed;
  int next = 0;
  for_each_tuning(changed, [&next](std::string_view, auto& tuning) {
    using Tuning = std::remove_cvref_t<decltype(tuning)>;
    for (const TuningValue<Tuning>& value : Tuning::kValues) {
      ++next;
      const auto change = [&](auto member) {
        auto& changed_value = tuning.*member;
        using Value = std::remove_cvref_t<decltype(changed_value)>;
        if constexpr (std::is_integral_v<Value>) {
          changed_value += static_cast<Value>(1 + next % 20);
        } else {
          changed_value *= 0.5 + next / 1000.0;
        }
      };
      std::visit(change, value.member);
    }
  });
  const TemporaryFile file(tuning_text(changed));
  const Result<Configuration> config = load_configuration(file.path());
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(tuning_text(*config), tuning_text(changed));
  EXPECT_EQ(config->backend.tuning.matcher.edge_penalty, changed.backend.tuning.matcher.edge_penalty);
}

TEST(TuningTables, TellRealNumbersFromCountsAndGiveTheirRange) {
  EXPECT_THAT(
      tuning_text({}),
      HasSubstr("\nrefile_m = 0.2  # 0.002 to 20\nmax_points_per_traversal = 256  # 2.56 to 25600\n"));
  EXPECT_THAT(tuning_text({}), HasSubstr("= 1e-05  # "));
}

TEST(ConfigurationTables, NameEachMemberOnce) {
  std::set<std::string> names;
  std::set<const void*> places;
  for_each_setting(Configuration(), [&](const auto& section, const auto& setting) {
    EXPECT_TRUE(names.insert(name_of(setting)).second) << name_of(setting);
    const auto place = [&section](auto member) -> const void* { return &(section.*member); };
    EXPECT_TRUE(places.insert(std::visit(place, setting.member)).second) << name_of(setting);
  });
}

/// A value of the type of the default, as a file has it.
struct ValueInFile {
  double lowest;
  double highest;

  std::string operator()(bool value) const { return value ? "false" : "true"; }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(double) const { return std::to_string((lowest + highest) / 2.0); }
  std::string operator()(const std::optional<double>&) const { return (*this)(0.0); }
  std::string operator()(const std::string&) const { return "\"OTHER_\""; }
};

TEST(ConfigurationTables, EachSettingIsSetByItsName) {
  for_each_setting(Configuration(), [](const auto& section, const auto& setting) {
    const ValueInFile in_file{setting.lowest, setting.highest};
    const std::string value =
        std::visit([&](auto member) { return in_file(section.*member); }, setting.member);
    const std::string content =
        "[" + std::string(section.kSection.name) + "]\n" + std::string(setting.key) + " = " + value + "\n";
    // A value in the middle of its range may disagree with the others' defaults, but is known and of its
    // type.
    EXPECT_THAT(refusal_of(content),
                testing::Not(testing::AnyOf(HasSubstr("unknown"), HasSubstr("must be a"))))
        << content;
  });
}

/// Puts a number into a setting that is one.
template <typename Section>
void set_number(Section& section, const Setting<Section>& setting, double number) {
  std::visit(
      [&](auto member) {
        auto& value = section.*member;
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, int>) value = static_cast<int>(number);
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
          value = number;
      },
      setting.member);
}

/// Each of these bounds the other: who moves one far moves both.
constexpr std::pair<std::string_view, std::string_view> kBoundToEachOther[] = {
    {"association_keyframes", "window_keyframes"}, {"max_file_mb", "max_total_mb"}};

template <typename Section>
void move_what_is_bound_to(std::string_view key, Section& section, double number) {
  for (const auto& [one, other] : kBoundToEachOther) {
    const std::string_view bound = key == one ? other : key == other ? one : std::string_view();
    for (const auto& setting : Section::kSettings)
      if (setting.key == bound)
        set_number(section, setting, std::clamp(number, setting.lowest, setting.highest));
  }
}

TEST(ConfigurationTables, EachSettingTakesBothEndsOfItsRange) {
  for_each_setting(Configuration(), [](const auto& section, const auto& setting) {
    for (const double end : {setting.lowest, setting.highest}) {
      auto changed = section;
      set_number(changed, setting, end);
      move_what_is_bound_to(setting.key, changed, end);
      EXPECT_THAT(changed.validate(), IsEmpty()) << name_of(setting) << " = " << end;
    }
  });
}

TEST(ConfigurationReference, IsThePageInTheRepository) {
  std::ifstream file(checkout() / "docs/configuration.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_TRUE(page.str() == configuration_reference())  // not EXPECT_EQ: it would print both pages
      << "write it anew: swiftletd --print-configuration-reference > docs/configuration.md";
}

TEST(Configuration, DefaultsAreUsable) { EXPECT_THAT(Configuration{}.validate(), IsEmpty()); }

TEST(Configuration, NamesEverythingThatIsWrongAtOnce) {
  Configuration config;
  config.frontend.keyframe_distance_m = -1.0;
  config.map.resolution_m = 0.0;
  config.publish.channel_prefix = "two words";
  EXPECT_THAT(config.validate(), testing::UnorderedElementsAre(HasSubstr("frontend.keyframe_distance_m = -1"),
                                                               HasSubstr("map.resolution_m = 0"),
                                                               HasSubstr("publish.channel_prefix")));
}

TEST(Configuration, RefusesValuesThatDisagree) {
  Configuration config;
  config.sensor.min_range_m = 2.0;
  config.sensor.max_range_m = 1.0;
  config.record.max_file_mb = config.record.max_total_mb + 1;
  EXPECT_THAT(config.validate(), testing::ElementsAre(HasSubstr("less than sensor.max_range_m"),
                                                      HasSubstr("less than record.max_file_mb")));
}

TEST(Configuration, NotANumberIsNoValue) {
  Configuration config;
  config.map.clear_range_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(config.validate(), testing::ElementsAre(HasSubstr("map.clear_range_m")));
}

TEST(LoadConfiguration, TakesWhatIsGivenAndKeepsTheDefaultsOfTheRest) {
  const TemporaryFile file(
      "[frontend]\nkeyframe_distance_m = 1\n[sensor]\nrange_age_s = 0.25\n[publish]\nchannel_prefix = "
      "\"A_\"\n"
      "[backend]\nclose_loops = false\noptimizer_iterations = 7\n");
  const Result<Configuration> config = load_configuration(file.path());
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->frontend.keyframe_distance_m, 1.0) << "whole numbers may stand for real ones";
  EXPECT_EQ(config->sensor.range_age_s, 0.25);
  EXPECT_EQ(config->publish.channel_prefix, "A_");
  EXPECT_FALSE(config->backend.close_loops);
  EXPECT_EQ(config->backend.optimizer_iterations, 7);
  EXPECT_EQ(config->frontend.min_line_points, FrontendConfig{}.min_line_points);
}

TEST(LoadConfiguration, SaysWhenThereIsNoSuchFile) {
  const Result<Configuration> config = load_configuration("/nowhere/to/be/found.toml");
  ASSERT_FALSE(config);
  EXPECT_EQ(config.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(config.error().message, HasSubstr("/nowhere/to/be/found.toml"));
}

TEST(LoadConfiguration, SaysWhyAPathCannotBeLookedUp) {
  const std::filesystem::path circle = std::filesystem::path(testing::TempDir()) / "circle.toml";
  std::filesystem::remove(circle);
  std::filesystem::create_symlink(circle, circle);
  for (const std::string& path : {circle.string(), std::string(5000, 'x')}) {
    const Result<Configuration> config = load_configuration(path);
    ASSERT_FALSE(config);
    EXPECT_EQ(config.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(config.error().message,
                AllOf(StartsWith(path + ": cannot be looked up: "), HasSubstr("; correct its path")));
  }
  std::filesystem::remove(circle);
}

TEST(LoadConfiguration, TakesSettingsAboveThoseOfTheFile) {
  const TemporaryFile file("[map]\nresolution_m = 0.1\nclear_range_m = 2\n");
  const Result<Configuration> both = load_configuration(file.path(), "map.resolution_m = 0.2");
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->map.resolution_m, 0.2);
  EXPECT_EQ(both->map.clear_range_m, 2.0);
  const Result<Configuration> alone = load_configuration("", "map.resolution_m = 0.2");
  ASSERT_TRUE(alone) << alone.error().message;
  EXPECT_EQ(alone->map.resolution_m, 0.2);
  EXPECT_EQ(alone->map.clear_range_m, MapConfig{}.clear_range_m);
}

TEST(LoadConfiguration, NamesAFaultOfTheFileOrOfTheSettingsAboveIt) {
  const TemporaryFile file("[map]\nresolution_m = 99\n");
  const Result<Configuration> settings = load_configuration("", "map.resolution_m = 99");
  ASSERT_FALSE(settings);
  EXPECT_THAT(settings.error().message, StartsWith("settings: map.resolution_m"));
  const Result<Configuration> both = load_configuration(file.path(), "map.resolution = 1");
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message, AllOf(HasSubstr(".toml:2: map.resolution_m"),
                                          HasSubstr("settings: unknown key \"map.resolution\"")));
}

TEST(LoadConfiguration, RefusesUnknownKeysAndSectionsWithFileAndLine) {
  EXPECT_THAT(refusal_of("[map]\nresolution_m = 0.1\nresolution = 0.1\n"),
              AllOf(HasSubstr(".toml:3:"), HasSubstr("unknown key \"map.resolution\"")));
  EXPECT_THAT(refusal_of("\n[maps]\n"), AllOf(HasSubstr(".toml:2:"), HasSubstr("unknown section \"maps\"")));
  EXPECT_THAT(refusal_of("rate = 3\n"), AllOf(HasSubstr(".toml:1:"), HasSubstr("unknown key \"rate\"")));
}

TEST(LoadConfiguration, RefusesUnknownTuningAndItsWrongTypesWithFileAndLine) {
  EXPECT_THAT(refusal_of("[tuning.matcher]\n"),
              AllOf(HasSubstr(".toml:1:"), HasSubstr("unknown section \"tuning.matcher\"")));
  EXPECT_THAT(refusal_of("[tuning]\nmap_drawing.follow = 1\n"),
              AllOf(HasSubstr(".toml:2:"), HasSubstr("unknown key \"tuning.map_drawing.follow\"")));
  EXPECT_THAT(refusal_of("[tuning]\nmap_drawing.max_returns_moved = -1\n"),
              HasSubstr("tuning.map_drawing.max_returns_moved must be a whole number, not negative"));
}

TEST(LoadConfiguration, RefusesImpossibleTuningWithFileAndLine) {
  const auto refusal = [](const std::string& value) { return refusal_of("[tuning]\n" + value + "\n"); };
  EXPECT_THAT(refusal("backend_matcher.floor_sigma_m = -0.05"),
              AllOf(HasSubstr(".toml:2:"), HasSubstr("tuning.backend_matcher.floor_sigma_m = -0.05: must lie "
                                                     "between 0.0005 and 5")));
  for (const char* number : {"0", "nan", "inf", "1e9", "1e-9"})
    EXPECT_THAT(refusal(std::string("backend_matcher.floor_sigma_m = ") + number),
                HasSubstr("must lie between"));
  EXPECT_THAT(refusal("backend_patches.min_returns = 0"), HasSubstr("must lie between 1 and 800"));
  EXPECT_THAT(refusal("frontend_axis.other_axis_keyframes = -1"), HasSubstr("must lie between 1 and 2400"));
  EXPECT_THAT(refusal("backend_refinement.step_weight = 30"), HasSubstr("between 0.0025 and 25"));
  EXPECT_THAT(refusal("map_walls.occupied_percent = 130"), HasSubstr("between 1 and 100"));
  EXPECT_EQ(refusal("backend_walls.rival_share = 1.0"), "accepted");
  EXPECT_EQ(refusal("backend_matcher.floor_sigma_m = 0.1"), "accepted");
}

TEST(LoadConfiguration, RefusesARepeatedKeyWithFileAndLine) {
  EXPECT_THAT(refusal_of("[map]\nresolution_m = 0.1\nresolution_m = 0.2\n"), HasSubstr(".toml:3:"));
}

TEST(LoadConfiguration, RefusesTheWrongTypeWithFileAndLine) {
  EXPECT_THAT(refusal_of("[map]\nresolution_m = \"small\"\n"),
              AllOf(HasSubstr(".toml:2:"), HasSubstr("map.resolution_m must be a number")));
  EXPECT_THAT(refusal_of("[backend]\nclose_loops = 1\n"), HasSubstr("must be true or false"));
  EXPECT_THAT(refusal_of("[backend]\noptimizer_iterations = 1.5\n"), HasSubstr("must be a whole number"));
  EXPECT_THAT(refusal_of("[publish]\nchannel_prefix = 1\n"), HasSubstr("must be a text in quotes"));
}

TEST(LoadConfiguration, RefusesImpossibleValuesWithFileAndLine) {
  EXPECT_THAT(
      refusal_of("[map]\n\nresolution_m = -0.1\n"),
      AllOf(HasSubstr(".toml:3:"), HasSubstr("map.resolution_m = -0.1: must lie between 0.01 and 1")));
  EXPECT_THAT(refusal_of("[backend]\noptimizer_iterations = 99999999999999\n"), HasSubstr(".toml:2:"));
  EXPECT_THAT(refusal_of("[map]\nresolution_m = nan\n"), HasSubstr(".toml:2:"));
  for (const char* const beyond_2_53 : {"9007199254740993", "-9223372036854775808"})
    EXPECT_THAT(refusal_of(std::string("[map]\nresolution_m = ") + beyond_2_53 + "\n"),
                AllOf(HasSubstr(".toml:2:"), HasSubstr("must lie between 0.01 and 1")));
}

TEST(LoadConfiguration, RefusesWhatOnlyTheWholeTellsWithFileAndLine) {
  EXPECT_THAT(refusal_of("[backend]\n\nmax_kernel_cells = 4\n"),
              AllOf(HasSubstr(".toml:3:"), HasSubstr("backend.max_kernel_cells must be odd")));
  EXPECT_THAT(refusal_of("[frontend]\nassociation_keyframes = 30\n"), HasSubstr(".toml:2:"));
  EXPECT_THAT(refusal_of("[publish]\nchannel_prefix = \"a b\"\n"), HasSubstr(".toml:2:"));
  EXPECT_THAT(refusal_of("[frontend]\nwindow_keyframes = 5\n"),
              HasSubstr(".toml: frontend.association_keyframes must be"))
      << "the file does not have that key";
}

TEST(LoadConfiguration, RefusesWhatIsNoToml) { EXPECT_THAT(refusal_of("[map\n"), HasSubstr(".toml:1:")); }

TEST(LoadConfiguration, NamesAllProblemsInTheOrderOfTheirLines) {
  const std::string refusal = refusal_of("[publish]\nstatus_period_s = 0\n[map]\nresolution = 1\n");
  EXPECT_LT(refusal.find(".toml:2:"), refusal.find(".toml:4:"));
  EXPECT_THAT(refusal, HasSubstr(".toml:4:"));
}

std::vector<std::string> values_of(const Configuration& config) {
  std::vector<std::string> values;
  for_each_setting(config, [&values](const auto& section, const auto& setting) {
    const auto text = [&section](auto member) { return testing::PrintToString(section.*member); };
    values.push_back(name_of(setting) + " = " + std::visit(text, setting.member));
  });
  return values;
}

TEST(ShippedConfiguration, HoldsDefaultsOnly) {
  const Result<Configuration> shipped = load_configuration(shipped_file());
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(values_of(*shipped), values_of(Configuration()));
}

TEST(ShippedConfiguration, CommentsEachKeyAsTheTablesDo) {
  std::map<std::string, std::string_view> texts;
  for_each_setting(Configuration(), [&texts](const auto&, const auto& setting) {
    texts.emplace(name_of(setting), setting.text);
  });
  std::ifstream file(shipped_file());
  std::string section;
  std::size_t keys = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("[")) section = line.substr(1, line.find(']') - 1);
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("#") || equals == std::string::npos) continue;
    const std::string name = section + "." + line.substr(0, equals);
    EXPECT_THAT(line, testing::EndsWith("  # " + std::string(texts[name]))) << name;
    ++keys;
  }
  EXPECT_GT(keys, 0U);
}

}  // namespace
}  // namespace swiftlet
