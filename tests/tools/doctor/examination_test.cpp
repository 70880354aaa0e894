// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/examination.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/firmware_link/scripted_clock.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"
#include "tests/tools/doctor/fake_system.hpp"
#include "tests/tools/doctor/fake_usb_bus.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

constexpr const char* kRadio = "radio://0/80/2M/E7E7E7E7E7";
constexpr const char* kUdp = "udp://127.0.0.1:19850";

class WorkingNetwork final : public Network {
 public:
  std::optional<NetworkRoute> route_to(const std::string& /*address*/) override {
    return NetworkRoute{"lo", true, true};
  }
  Status send_to_self(const std::string& /*group*/) override { return {}; }
};

/// Counts itself while it lives.
class CountedLink final : public Link {
 public:
  explicit CountedLink(int& count) : count_(count) { ++count_; }
  ~CountedLink() override { --count_; }

  ScriptedLink scripted;
  Result<LinkFrame> receive(Duration timeout) override { return scripted.receive(timeout); }
  Status send(std::span<const std::uint8_t> packet) override { return scripted.send(packet); }
  LinkStatistics statistics() const override { return {.condition = condition}; }
  LinkCondition condition = LinkCondition::kSilent;

 private:
  int& count_;
};

class Examination : public testing::Test {
 protected:
  Examination() {
    bus_.devices = {crazyradio_pa()};
    variables_ = ScriptedVehicle::modern_variables();
  }

  Findings run(const char* input) {
    const InputUri uri = parse_input_uri(input).value();
    const Surroundings around{.files = system_.files(),
                              .network = network_,
                              .usb_bus = &bus_,
                              .cache = cache_,
                              .recording_directory = "/tmp",
                              .open_link = [this](const InputUri&) { return open_link(); },
                              .scan =
                                  [this](const RadioAddress&) {
                                    EXPECT_EQ(open_links_, 0) << "the dongle serves one at a time";
                                    ++scans_;
                                    return scanned_;
                                  }};
    return examine(uri, LcmUrl{}, around);
  }
  static Finding find(const Findings& findings, const std::string& check) {
    const auto found = std::find_if(findings.begin(), findings.end(),
                                    [&check](const Finding& finding) { return finding.check == check; });
    return found == findings.end() ? Finding{Mark::kOk, "missing", "", ""} : *found;
  }
  static std::vector<std::string> names(const Findings& findings) {
    std::vector<std::string> all;
    for (const Finding& finding : findings) all.push_back(finding.check);
    std::sort(all.begin(), all.end());
    return all;
  }

  FakeUsbBus bus_;
  FakeSystem system_;
  std::vector<ScriptedVehicle::Variable> variables_;
  bool vehicle_answers_ = true;
  std::vector<RadioAddress> scanned_;
  int scans_ = 0;
  LinkCondition condition_ = LinkCondition::kSilent;
  int links_ = 0;
  int open_links_ = 0;

 private:
  Result<LinkInput> open_link() {
    ++links_;
    auto link = std::make_unique<CountedLink>(open_links_);
    link->scripted.vehicle.variables = variables_;
    link->condition = condition_;
    link->scripted.reaches = [this](std::int64_t) { return vehicle_answers_; };
    LinkInput input;
    input.clock = std::make_shared<ScriptedClock>(link->scripted);
    input.link = std::move(link);
    return input;
  }

  WorkingNetwork network_;
  TocCache cache_;
};

TEST_F(Examination, AGoodDongleAndVehicleHaveNoProblem) {
  const Findings findings = run(kRadio);
  for (const Finding& finding : findings) {
    if (finding.check == "battery") continue;  // the scripted vehicle's shows 1 V
    EXPECT_NE(finding.mark, Mark::kProblem) << finding.check << ": " << finding.found;
  }
  EXPECT_EQ(find(findings, "vehicle").found, "Crazyflie 2.1 answers");
  EXPECT_EQ(find(findings, "log").mark, Mark::kOk);
  EXPECT_EQ(scans_, 0);
}

TEST_F(Examination, EveryCheckIsNamedOnceWhateverTheInput) {
  const std::vector<std::string> by_radio = names(run(kRadio));
  EXPECT_EQ(std::adjacent_find(by_radio.begin(), by_radio.end()), by_radio.end());
  EXPECT_EQ(names(run(kUdp)), by_radio);
  EXPECT_EQ(names(run("sim://office")), by_radio);
  EXPECT_EQ(names(run("usb://0")), by_radio);
  vehicle_answers_ = false;
  EXPECT_EQ(names(run(kRadio)), by_radio);
  bus_.devices.clear();
  EXPECT_EQ(names(run(kRadio)), by_radio);
}

TEST_F(Examination, TheVehicleIsNotAskedThroughADongleThatCannotBeUsed) {
  bus_.opening = UsbOutcome::kBusy;
  const Findings findings = run(kRadio);
  EXPECT_EQ(find(findings, "in use").mark, Mark::kProblem);
  EXPECT_EQ(find(findings, "vehicle").mark, Mark::kSkipped);
  bus_.opening = UsbOutcome::kDone;
  bus_.devices[0].access = UsbOutcome::kAccessDenied;
  EXPECT_EQ(find(run(kRadio), "in use").mark, Mark::kSkipped);
  bus_.devices[0] = crazyradio_pa();
  bus_.devices[0].release_bcd = 0x0030;
  EXPECT_EQ(find(run(kRadio), "vehicle").mark, Mark::kSkipped);
  EXPECT_EQ(links_, 0);
}

TEST_F(Examination, AVehicleThatDoesNotAnswerIsLookedForElsewhere) {
  vehicle_answers_ = false;
  EXPECT_THAT(find(run(kRadio), "vehicle").found, HasSubstr("on any other channel"));
  RadioAddress elsewhere;
  elsewhere.channel = 90;
  elsewhere.rate = RadioRate::k250Kbps;
  scanned_ = {elsewhere};
  const Findings findings = run(kRadio);
  EXPECT_EQ(find(findings, "vehicle").mark, Mark::kProblem);
  EXPECT_THAT(find(findings, "vehicle").found, HasSubstr("radio://0/90/250K/E7E7E7E7E7"));
  EXPECT_EQ(find(findings, "battery").mark, Mark::kSkipped);
}

TEST_F(Examination, ADongleThatFailsOnTheWayIsNotTheVehiclesFault) {
  vehicle_answers_ = false;
  condition_ = LinkCondition::kDeviceFault;
  EXPECT_THAT(find(run(kRadio), "vehicle").found, HasSubstr("fails (I/O error)"));
  EXPECT_EQ(scans_, 0);
}

TEST_F(Examination, UdpNeedsNoDongle) {
  bus_.devices.clear();
  const Findings findings = run(kUdp);
  EXPECT_THAT(find(findings, "dongle").found, HasSubstr("udp://"));
  EXPECT_EQ(find(findings, "vehicle").mark, Mark::kOk);
  vehicle_answers_ = false;
  EXPECT_THAT(find(run(kUdp), "vehicle").remedy, HasSubstr("swiftlet sim"));
  EXPECT_EQ(scans_, 0);
}

TEST_F(Examination, TheCableTakesTheDonglesPlace) {
  EXPECT_EQ(find(run("usb://0"), "cable").mark, Mark::kProblem);
  UsbIdentity vehicle = plugged_in_at(1, 9, 0x0483, 0x5740);
  vehicle.manufacturer = "Bitcraze AB";
  bus_.devices = {vehicle};
  const Findings findings = run("usb://0");
  EXPECT_EQ(find(findings, "dongle").mark, Mark::kSkipped);
  EXPECT_EQ(find(findings, "cable").mark, Mark::kOk);
  EXPECT_EQ(find(findings, "vehicle").mark, Mark::kOk);
}

TEST_F(Examination, RecordingsAndSimulationsNeedNeitherDongleNorVehicle) {
  bus_.devices.clear();
  const Findings findings = run("sim://office");
  EXPECT_EQ(find(findings, "dongle").mark, Mark::kSkipped);
  EXPECT_EQ(find(findings, "vehicle").mark, Mark::kSkipped);
  EXPECT_EQ(find(findings, "lcm self-test").mark, Mark::kOk);
  EXPECT_EQ(links_, 0);
}

}  // namespace
}  // namespace swiftlet
