// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/storage_checks.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

TEST(CheckStorage, ADirectoryThatCanBeMadeIsGoodAndIsNotMade) {
  const TemporaryDirectory directory;
  const fs::path wanted = directory.path() / "state" / "swiftlet";
  const Finding finding = check_storage(wanted);
  EXPECT_EQ(finding.mark, Mark::kOk);
  EXPECT_THAT(finding.found, AllOf(HasSubstr(wanted.string()), HasSubstr("MB free")));
  EXPECT_FALSE(fs::exists(wanted));
}

TEST(CheckStorage, AFileInTheWayIsNamed) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "state") << "in the way";
  const Finding finding = check_storage(directory.path() / "state" / "swiftlet");
  EXPECT_EQ(finding.mark, Mark::kWarning);
  EXPECT_THAT(finding.found, HasSubstr((directory.path() / "state").string() + " is no directory"));
}

/// As a user who is not root and owns nothing there.
Mark mark_for_a_stranger(const fs::path& directory) {
  constexpr uid_t kNobody = 65534;
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(-1);
    _exit(static_cast<int>(check_storage(directory).mark));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return static_cast<Mark>(WEXITSTATUS(status));
}

TEST(CheckStorage, ADirectoryThatMayNotBeWrittenIsAWarning) {
  const TemporaryDirectory directory;
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const Mark mark = mark_for_a_stranger(directory.path() / "swiftlet");
  fs::permissions(directory.path(), fs::perms::owner_all);
  EXPECT_EQ(mark, Mark::kWarning);
}

TEST(CheckStorage, WithoutAHomeThereIsNowhereToKeepThem) {
  EXPECT_EQ(check_storage({}).mark, Mark::kWarning);
}

}  // namespace
}  // namespace swiftlet
