// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/toc_cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace swiftlet {
namespace {

class TocCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::temp_directory_path() /
                 ("swiftlet_toc_cache_" + std::to_string(::getpid()) + test->name());
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  [[nodiscard]] std::filesystem::path only_file() const {
    return std::filesystem::directory_iterator(directory_)->path();
  }

  std::filesystem::path directory_;
  TocInfo info_{2, 0x714CA18C};
  std::vector<TocItem> items_{{0, 2, "range.front"}, {1, 7, "stateEstimate.x"}};
};

TEST_F(TocCacheTest, RemembersAcrossRuns) {
  TocCache(directory_ / "deep").store(5, info_, items_);
  TocCache later(directory_ / "deep");
  EXPECT_EQ(later.load(5, info_), items_);
}

TEST_F(TocCacheTest, DistinguishesPortsLengthsAndCrcs) {
  TocCache cache(directory_);
  cache.store(5, info_, items_);
  EXPECT_FALSE(cache.load(2, info_).has_value());
  EXPECT_FALSE(cache.load(5, {3, info_.crc}).has_value());
  EXPECT_FALSE(cache.load(5, {2, info_.crc + 1}).has_value());
}

TEST_F(TocCacheTest, RemembersInMemoryWithoutADirectory) {
  TocCache cache;
  EXPECT_FALSE(cache.load(5, info_).has_value());
  cache.store(5, info_, items_);
  EXPECT_EQ(cache.load(5, info_), items_);
  cache.forget(5, info_);
  EXPECT_FALSE(cache.load(5, info_).has_value());
}

TEST_F(TocCacheTest, ADamagedFileIsNoTable) {
  TocCache(directory_).store(5, info_, items_);
  for (const char* text :
       {"", "swiftlet-toc-1\n0 2 range.front\n", "swiftlet-toc-1\n0 2 range.front\n2 7 a.b\n",
        "swiftlet-toc-1\n0 2 range.front\n1 999 a.b\n", "other\n0 2 a.b\n1 2 c.d\n",
        "swiftlet-toc-1\n0 2 range.front\n1 7 nogroup\n"}) {
    std::ofstream(only_file(), std::ios::trunc) << text;
    EXPECT_FALSE(TocCache(directory_).load(5, info_).has_value()) << text;
  }
}

TEST_F(TocCacheTest, ForgettingRemovesTheFile) {
  TocCache cache(directory_);
  cache.store(5, info_, items_);
  cache.forget(5, info_);
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST_F(TocCacheTest, ADirectoryThatCannotBeWrittenCostsOnlyTheFile) {
  TocCache cache("/proc/swiftlet");
  cache.store(5, info_, items_);
  EXPECT_EQ(cache.load(5, info_), items_);
}

TEST_F(TocCacheTest, DefaultsToTheUsersCacheDirectory) {
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  const std::string before = xdg == nullptr ? "" : xdg;
  ::unsetenv("CACHE_DIRECTORY");
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(TocCache::default_directory(), "/somewhere/swiftlet");
  if (xdg == nullptr) {
    ::unsetenv("XDG_CACHE_HOME");
  } else {
    ::setenv("XDG_CACHE_HOME", before.c_str(), 1);
  }
}

}  // namespace
}  // namespace swiftlet
