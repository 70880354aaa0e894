// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/real_time_checks.hpp"

#include <gmock/gmock.h>

#include "tests/tools/doctor/fake_system.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kLimits =
    "Limit                     Soft Limit           Hard Limit           Units     \n"
    "Max locked memory         8388608              8388608              bytes     \n"
    "Max realtime priority     0                    0                    \n";
constexpr const char* kNoCapabilities = "Name:\tswiftlet\nCapEff:\t0000000000000000\n";

class RealTimeChecks : public testing::Test {
 protected:
  RealTimeChecks() {
    system_.write("/proc/self/limits", kLimits);
    system_.write("/proc/self/status", kNoCapabilities);
    system_.write("/proc/version", "Linux version 6.1.0-18-amd64 #1 SMP PREEMPT_DYNAMIC\n");
  }
  FakeSystem system_;
};

TEST_F(RealTimeChecks, SayWhatIsMissingAndHowToGrantIt) {
  const Findings findings = check_real_time(system_.files());
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].mark, Mark::kOk);
  EXPECT_THAT(findings[0].found, AllOf(HasSubstr("RLIMIT_RTPRIO 0"), HasSubstr("ordinary kernel")));
  EXPECT_THAT(findings[0].remedy, HasSubstr("/etc/security/limits.d"));
  EXPECT_THAT(findings[1].found, HasSubstr("RLIMIT_MEMLOCK 8388608"));
  EXPECT_EQ(findings[1].remedy, findings[0].remedy);
}

TEST_F(RealTimeChecks, SeeALimitAndARealTimeKernel) {
  system_.write("/proc/self/limits",
                "Max locked memory         unlimited            unlimited            bytes     \n"
                "Max realtime priority     95                   95                   \n");
  system_.write("/proc/version", "Linux version 6.1.0-18-rt-amd64 #1 SMP PREEMPT_RT\n");
  const Findings findings = check_real_time(system_.files());
  EXPECT_THAT(findings[0].found, AllOf(HasSubstr("up to 95"), HasSubstr("PREEMPT_RT")));
  EXPECT_EQ(findings[0].remedy, "");
  EXPECT_THAT(findings[1].found, HasSubstr("without limit"));
}

TEST_F(RealTimeChecks, SeeCapabilities) {
  system_.write("/proc/self/status", "CapEff:\t0000000000804000\n");
  const Findings findings = check_real_time(system_.files());
  EXPECT_THAT(findings[0].found, HasSubstr("CAP_SYS_NICE"));
  EXPECT_THAT(findings[1].found, HasSubstr("CAP_IPC_LOCK"));
}

}  // namespace
}  // namespace swiftlet
