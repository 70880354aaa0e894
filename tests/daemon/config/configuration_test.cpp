// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <tuple>

#include "daemon/config/configuration_fields.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

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

std::size_t table_count(std::string_view section) {
  std::size_t count = 0;
  for (const ConfigurationField& field : configuration_fields()) count += field.section == section ? 1U : 0U;
  return count;
}

TEST(ConfigurationFields, HoldEveryFieldOfEverySection) {
  EXPECT_EQ(table_count("sensor"), sizeof(SensorOverrides) / sizeof(std::optional<double>));
  EXPECT_EQ(table_count("frontend"), field_count<FrontendConfig>());
  EXPECT_EQ(table_count("backend"), field_count<BackendConfig>());
  EXPECT_EQ(table_count("map"), field_count<MapConfig>());
  EXPECT_EQ(table_count("publish"), field_count<PublishConfig>());
  EXPECT_EQ(table_count("record"), field_count<RecordConfig>());
  EXPECT_EQ(table_count("realtime"), field_count<RealtimeConfig>());
  EXPECT_EQ(configuration_fields().size(),
            table_count("sensor") + table_count("frontend") + table_count("backend") + table_count("map") +
                table_count("publish") + table_count("record") + table_count("realtime"));
}

TEST(ConfigurationFields, NameEachFieldOnce) {
  Configuration config;
  std::set<std::pair<std::string_view, std::string_view>> names;
  std::set<const void*> places;
  for (const ConfigurationField& field : configuration_fields()) {
    EXPECT_TRUE(names.emplace(field.section, field.key).second) << field.key;
    const void* place = std::visit([](auto* at) -> const void* { return at; }, field.in(config));
    EXPECT_TRUE(places.insert(place).second) << field.key;
  }
}

TEST(ConfigurationFields, CanBeSetEachByItsName) {
  for (const ConfigurationField& field : configuration_fields()) {
    Configuration defaults;
    const std::string value = std::visit(
        [&field](const auto* at) -> std::string {
          using Field = std::remove_cvref_t<decltype(*at)>;
          if constexpr (std::is_same_v<Field, bool>) return *at ? "false" : "true";
          if constexpr (std::is_same_v<Field, std::string>) return "\"OTHER_\"";
          std::ostringstream text;
          if constexpr (std::is_same_v<Field, int>) {
            text << *at;
          } else {
            text << (field.lowest + field.highest) / 2.0;
          }
          return text.str();
        },
        field.in(defaults));
    const std::string content =
        "[" + std::string(field.section) + "]\n" + std::string(field.key) + " = " + value + "\n";
    // A value in the middle of its bounds may disagree with the others' defaults, but is known and of its
    // type.
    EXPECT_THAT(refusal_of(content),
                testing::Not(testing::AnyOf(HasSubstr("unknown"), HasSubstr("must be a"))))
        << content;
  }
}

/// Puts a number into a field that is one.
struct SetTo {
  double value;

  void operator()(bool*) const {}
  void operator()(int* field) const { *field = static_cast<int>(value); }
  void operator()(double* field) const { *field = value; }
  void operator()(std::optional<double>* field) const { *field = value; }
  void operator()(std::string*) const {}
};

/// Each of these bounds the other: whoever moves one far moves both.
constexpr std::pair<std::string_view, std::string_view> kBoundToEachOther[] = {
    {"association_keyframes", "window_keyframes"}, {"max_file_mb", "max_total_mb"}};

const ConfigurationField* bound_to(const ConfigurationField& field) {
  for (const auto& [one, other] : kBoundToEachOther) {
    const std::string_view key = field.key == one ? other : field.key == other ? one : std::string_view();
    for (const ConfigurationField& candidate : configuration_fields())
      if (candidate.section == field.section && candidate.key == key) return &candidate;
  }
  return nullptr;
}

TEST(ConfigurationFields, CanTakeBothEndsOfTheirRange) {
  for (const ConfigurationField& field : configuration_fields()) {
    for (const double end : {field.lowest, field.highest}) {
      Configuration config;
      std::visit(SetTo{end}, field.in(config));
      if (const ConfigurationField* other = bound_to(field))
        std::visit(SetTo{std::clamp(end, other->lowest, other->highest)}, other->in(config));
      EXPECT_THAT(config.validate(), IsEmpty()) << field.section << "." << field.key << " = " << end;
    }
  }
}

TEST(ConfigurationReference, IsThePageInTheRepository) {
  std::ifstream file(SWIFTLET_SOURCE_DIR "/docs/configuration.md");
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

TEST(LoadConfiguration, RefusesUnknownKeysAndSectionsWithFileAndLine) {
  EXPECT_THAT(refusal_of("[map]\nresolution_m = 0.1\nresolution = 0.1\n"),
              AllOf(HasSubstr(".toml:3:"), HasSubstr("unknown key \"map.resolution\"")));
  EXPECT_THAT(refusal_of("\n[maps]\n"), AllOf(HasSubstr(".toml:2:"), HasSubstr("unknown section \"maps\"")));
  EXPECT_THAT(refusal_of("rate = 3\n"), AllOf(HasSubstr(".toml:1:"), HasSubstr("unknown key \"rate\"")));
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

TEST(ShippedConfigurations, AllLoad) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SWIFTLET_SOURCE_DIR "/daemon/config")) {
    if (entry.path().extension() != ".toml") continue;
    const Result<Configuration> config = load_configuration(entry.path().string());
    EXPECT_TRUE(config) << config.error().message;
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST(SensorOverrides, ReplaceOnlyWhatIsSet) {
  SensorOverrides overrides;
  overrides.range_sigma_m = 0.07;
  overrides.range_age_s = 0.02;
  overrides.odometry_forward_scale = 0.95;
  overrides.odometry_sideways_scale = 1.05;
  overrides.missed_yaw_per_metre_rad = 0.01;
  overrides.missed_yaw_per_radian = 0.02;
  overrides.missed_yaw_per_second_rad = 0.03;
  const SensorModel model = overrides.applied_to(SensorModel::crazyflie());
  EXPECT_EQ(model.range_sigma_m, 0.07);
  EXPECT_EQ(model.range_age, std::chrono::milliseconds(20));
  EXPECT_EQ(model.odometry_calibration.forward_scale, 0.95);
  EXPECT_EQ(model.odometry_calibration.sideways_scale, 1.05);
  EXPECT_EQ(model.odometry_calibration.yaw_per_metre_rad, 0.01);
  EXPECT_EQ(model.odometry_calibration.yaw_per_radian, 0.02);
  EXPECT_EQ(model.odometry_calibration.yaw_per_second_rad, 0.03);
  EXPECT_EQ(model.max_range_m, SensorModel::crazyflie().max_range_m);
}

}  // namespace
}  // namespace swiftlet
