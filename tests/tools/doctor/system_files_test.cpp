// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/system_files.hpp"

#include <gmock/gmock.h>

#include "tests/tools/doctor/fake_system.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(SystemFiles, ReadsFilesNumbersNamesAndLinks) {
  const FakeSystem system;
  system.write("/proc/a/number", "2097152\n");
  system.write("/proc/a/name", "radio\n");
  system.link("/proc/a/link", "/dev/null");
  const SystemFiles files = system.files();
  EXPECT_EQ(files.read("/proc/a/name"), "radio");
  EXPECT_EQ(files.read_number("/proc/a/number"), 2'097'152);
  EXPECT_EQ(files.target_of("/proc/a/link"), "/dev/null");
  EXPECT_THAT(files.names_in("/proc/a"), ElementsAre("link", "name", "number"));
  EXPECT_TRUE(files.exists("/proc/a"));
}

TEST(SystemFiles, WhatIsNotThereIsNoError) {
  const FakeSystem system;
  const SystemFiles files = system.files();
  EXPECT_EQ(files.read("/etc/none"), std::nullopt);
  EXPECT_EQ(files.read_number("/etc/none"), std::nullopt);
  EXPECT_EQ(files.target_of("/etc/none"), std::nullopt);
  EXPECT_THAT(files.names_in("/etc/none"), IsEmpty());
  EXPECT_FALSE(files.exists("/etc/none"));
}

TEST(SystemFiles, TextThatIsNoNumberIsNone) {
  const FakeSystem system;
  system.write("/a", "auto\n");
  EXPECT_EQ(system.files().read_number("/a"), std::nullopt);
}

TEST(FieldOf, FindsTheLineThatBeginsWithTheKey) {
  const char* text = "Name:\tswiftlet\nCapEff:\t0000000000800000\nEmpty:";
  EXPECT_EQ(field_of(text, "CapEff:"), "0000000000800000");
  EXPECT_EQ(field_of(text, "Empty:"), "");
  EXPECT_EQ(field_of(text, "Eff:"), std::nullopt);
}

}  // namespace
}  // namespace swiftlet
