// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/lcm_checks.hpp"

#include <gmock/gmock.h>

#include "tests/tools/doctor/fake_system.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;

class FakeNetwork final : public Network {
 public:
  std::optional<NetworkRoute> route = NetworkRoute{"eth0", false, true};
  Status received;
  int sent = 0;

  std::optional<NetworkRoute> route_to(const std::string& /*address*/) override { return route; }
  Status send_to_self(const std::string& /*group*/) override {
    ++sent;
    return received;
  }
};

class LcmChecks : public testing::Test {
 protected:
  LcmChecks() {
    system_.write("/proc/sys/net/core/rmem_max", "4194304\n");
    system_.write("/proc/sys/net/core/rmem_default", "2097152\n");
  }
  Findings check() { return check_lcm(url_, network_, system_.files()); }

  FakeSystem system_;
  FakeNetwork network_;
  LcmUrl url_;
};

TEST_F(LcmChecks, AllIsWellWhereMulticastWorksAndBuffersAreLarge) {
  const Findings findings = check();
  ASSERT_THAT(findings,
              AllOf(SizeIs(3), Each(Field(&Finding::mark, Mark::kOk)), Each(Field(&Finding::remedy, ""))));
  EXPECT_THAT(findings[0].found, HasSubstr("239.255.76.67 by eth0, this machine only"));
}

TEST_F(LcmChecks, WithoutARouteTheRemedyMakesOneAndNothingIsSent) {
  network_.route.reset();
  const Findings findings = check();
  EXPECT_EQ(findings[0].mark, Mark::kProblem);
  EXPECT_THAT(findings[0].remedy, AllOf(HasSubstr("ip link set lo up multicast on"),
                                        HasSubstr("ip route add 224.0.0.0/4 dev lo")));
  EXPECT_EQ(findings[1].mark, Mark::kSkipped);
  EXPECT_EQ(network_.sent, 0);
}

TEST_F(LcmChecks, LoopbackNeedsItsMulticastFlag) {
  network_.route = NetworkRoute{"lo", true, false};
  const Findings findings = check();
  EXPECT_EQ(findings[0].mark, Mark::kProblem);
  EXPECT_EQ(findings[0].remedy, "sudo ip link set lo multicast on");
}

TEST_F(LcmChecks, ALinkThatCannotMulticastIsAProblem) {
  network_.route = NetworkRoute{"wwan0", false, false};
  const Findings findings = check();
  EXPECT_EQ(findings[0].mark, Mark::kProblem);
  EXPECT_THAT(findings[0].found, HasSubstr("wwan0"));
}

TEST_F(LcmChecks, WarnsWhereOthersAreMeantToHearButTheRouteStaysHere) {
  network_.route = NetworkRoute{"lo", true, true};
  EXPECT_EQ(check()[0].mark, Mark::kOk);
  url_.ttl = 1;
  EXPECT_EQ(check()[0].mark, Mark::kWarning);
}

TEST_F(LcmChecks, ADatagramThatDoesNotComeBackIsAProblem) {
  network_.received = Error{ErrorCode::kTimeout, "a datagram did not come back"};
  const Findings findings = check();
  EXPECT_EQ(findings[1].mark, Mark::kProblem);
  EXPECT_THAT(findings[1].remedy, HasSubstr("firewall"));
}

TEST_F(LcmChecks, SmallBuffersAreAWarning) {
  system_.write("/proc/sys/net/core/rmem_default", "212992\n");
  const Findings findings = check();
  EXPECT_EQ(findings[2].mark, Mark::kWarning);
  EXPECT_THAT(findings[2].found, HasSubstr("rmem_default 212992"));
  EXPECT_THAT(findings[2].remedy, HasSubstr("sysctl -w net.core.rmem_default=2097152;"));
}

TEST_F(LcmChecks, BuffersThatTheKernelHidesAreSkipped) {
  const FakeSystem nothing;
  EXPECT_EQ(check_lcm(url_, network_, nothing.files())[2].mark, Mark::kSkipped);
}

TEST_F(LcmChecks, AreSkippedWhereLcmDoesNotGoOverTheNetwork) {
  url_.provider = LcmUrl::Provider::kOther;
  EXPECT_THAT(check(), AllOf(SizeIs(3), Each(Field(&Finding::mark, Mark::kSkipped))));
  EXPECT_EQ(network_.sent, 0);
}

}  // namespace
}  // namespace swiftlet
