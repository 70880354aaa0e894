// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/emulated_crazyradio.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using testing::ElementsAre;

VendorRequest request(std::uint8_t number, std::uint16_t value) { return {number, value, 0, {}}; }

class EmulatedCrazyradioTest : public testing::Test {
 protected:
  EmulatedCrazyradioTest()
      : vehicle_(make_simulated_world("loop").value(), {}, 1),
        receiver_(vehicle_, /*seed=*/1),
        dongle_(receiver_) {
    tune();
  }

  void tune() { EXPECT_EQ(dongle_.control_out(request(0x01, 80)), UsbOutcome::kDone); }
  Bytes read() {
    std::array<std::uint8_t, 64> buffer{};
    const UsbTransfer transfer = dongle_.bulk_in(buffer);
    EXPECT_TRUE(transfer.done());
    return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(transfer.size)};
  }
  UsbOutcome read_outcome() {
    std::array<std::uint8_t, 64> buffer{};
    return dongle_.bulk_in(buffer).outcome;
  }
  UsbOutcome write(const Bytes& packet) {
    const UsbOutcome outcome = dongle_.bulk_out(packet);
    dongle_.advance(milliseconds(10));
    return outcome;
  }

  SimulatedVehicle vehicle_;
  EmulatedReceiver receiver_;
  EmulatedCrazyradio dongle_;
};

TEST_F(EmulatedCrazyradioTest, AnswersEachPacketWithItsStatusAndPayload) {
  EXPECT_EQ(write({0xDD, 0x00}), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x01, 0xF3));
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x01, 0xDD, 0x00, 0x0C, 0x00, 0x00, 0x00));
}

TEST_F(EmulatedCrazyradioTest, AnswersASingleZeroWhenNobodyAcknowledges) {
  receiver_.in_range = false;
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x00));
}

TEST_F(EmulatedCrazyradioTest, TellsRetransmissionsInTheUpperHalfOfTheStatus) {
  receiver_.losses.packet = 0.5;
  std::array<int, 16> seen{};
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
    const Bytes answer = read();
    if ((answer[0] & 1U) != 0) ++seen[answer[0] >> 4U];
  }
  EXPECT_GT(seen[0], seen[1]);
  EXPECT_GT(seen[1], seen[3]);
  EXPECT_GT(seen[3], 0);
  EXPECT_EQ(seen[4], 0);
}

TEST_F(EmulatedCrazyradioTest, AnswersTooLateForTheHostAreFoundByItsNextRead) {
  dongle_.fail_next(DongleFault::kLateAnswer);
  EXPECT_EQ(write({0xDD, 0x00}), UsbOutcome::kDone);
  EXPECT_EQ(read_outcome(), UsbOutcome::kTimeout);
  dongle_.advance(milliseconds(500));
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x01, 0xF3));
  EXPECT_THAT(read(), ElementsAre(0x01, 0xDD, 0x00, 0x0C, 0x00, 0x00, 0x00));
}

TEST_F(EmulatedCrazyradioTest, TakesNoMorePacketsThanItHasRoomForAnswers) {
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kTimeout);
}

TEST_F(EmulatedCrazyradioTest, IgnoresAChannelThatDoesNotExist) {
  EXPECT_EQ(dongle_.control_out(request(0x01, 126)), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.setting().channel, 80);
}

TEST_F(EmulatedCrazyradioTest, StallsAShortAddressAndUnknownRequests) {
  EXPECT_EQ(dongle_.control_out({0x02, 0, 0, {0xE7, 0xE7}}), UsbOutcome::kStall);
  EXPECT_EQ(dongle_.control_out(request(0x23, 1)), UsbOutcome::kStall);
  EXPECT_EQ(dongle_.control_out({0x02, 0, 0, {1, 2, 3, 4, 5}}), UsbOutcome::kDone);
  EXPECT_THAT(dongle_.setting().address, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(dongle_.requests().size(), 2U);
}

TEST_F(EmulatedCrazyradioTest, DoesNotReadPacketsWhileItsCarrierIsOn) {
  EXPECT_EQ(dongle_.control_out(request(0x20, 1)), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kTimeout);
  EXPECT_EQ(dongle_.control_out(request(0x20, 0)), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
}

TEST_F(EmulatedCrazyradioTest, ACrazyradio2AcceptsWhatItDoesNotHaveAndAcknowledgesNothing) {
  EmulatedCrazyradio radio2(receiver_, DongleModel::k2);
  const auto answers = [&](const VendorRequest& setting) {
    EXPECT_EQ(radio2.control_out(request(0x01, 80)), UsbOutcome::kDone);
    EXPECT_EQ(radio2.control_out(request(0x03, 2)), UsbOutcome::kDone);
    EXPECT_EQ(radio2.control_out(setting), UsbOutcome::kDone);
    EXPECT_EQ(radio2.bulk_out(Bytes{0xFF}), UsbOutcome::kDone);
    radio2.advance(milliseconds(10));
    std::array<std::uint8_t, 64> buffer{};
    return radio2.bulk_in(buffer).size > 1;
  };
  EXPECT_TRUE(answers(request(0x22, 2)));
  EXPECT_FALSE(answers(request(0x03, 0)));
  EXPECT_FALSE(answers(request(0x01, 101)));
  EXPECT_FALSE(answers({0x30, 0, 0, {100, 0}}));
  EXPECT_EQ(radio2.reset(), UsbOutcome::kDone);
  EXPECT_FALSE(answers(request(0x06, 3))) << "loss is simulated on";
  EXPECT_TRUE(answers({0x30, 0, 0, {0, 0}}));
  EXPECT_FALSE(answers(request(0x24, 1)));
  EXPECT_EQ(radio2.control_out(request(0x24, 2)), UsbOutcome::kStall);
}

TEST_F(EmulatedCrazyradioTest, APaInAnotherModeSendsNothingNorAfterAReset) {
  EXPECT_EQ(dongle_.control_out(request(0x22, 2)), UsbOutcome::kDone);
  EXPECT_EQ(dongle_.reset(), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x00));
}

TEST_F(EmulatedCrazyradioTest, GivesNoAnswersWithAcksOff) {
  EXPECT_EQ(dongle_.control_out(request(0x10, 0)), UsbOutcome::kDone);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_EQ(read_outcome(), UsbOutcome::kTimeout);
}

TEST_F(EmulatedCrazyradioTest, AHaltedEndpointStallsUntilItIsCleared) {
  dongle_.fail_next(DongleFault::kStallOut);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kStall);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kStall);
  EXPECT_EQ(dongle_.clear_halt(EmulatedCrazyradio::kOut), UsbOutcome::kDone);
  dongle_.fail_next(DongleFault::kStallIn);
  EXPECT_EQ(write({0xFF}), UsbOutcome::kDone);
  EXPECT_EQ(read_outcome(), UsbOutcome::kStall);
  EXPECT_EQ(dongle_.clear_halt(EmulatedCrazyradio::kIn), UsbOutcome::kDone);
  EXPECT_THAT(read(), ElementsAre(0x01, 0xF3));
}

TEST_F(EmulatedCrazyradioTest, ComesBackFromUnpluggingUnderANewAddressWithoutItsSettings) {
  const std::uint8_t before = dongle_.bus_address();
  dongle_.unplug();
  EXPECT_EQ(write({0xFF}), UsbOutcome::kNoDevice);
  dongle_.plug_in();
  EXPECT_NE(dongle_.bus_address(), before);
  EXPECT_EQ(dongle_.setting().channel, 2);
}

}  // namespace
}  // namespace swiftlet
