// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/followed_link.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/temporary_file.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

ErrorCode code_of(const Result<LinkFrame>& frame) { return frame ? ErrorCode{} : frame.error().code; }

class FollowedLinkTest : public testing::Test {
 protected:
  void append(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary | std::ios::app).write(bytes.data(), std::ssize(bytes));
  }
  [[nodiscard]] Bytes next() {
    const Result<LinkFrame> frame = link_->receive(milliseconds(50));
    if (!frame) return {};
    return {frame->packet().begin(), frame->packet().end()};
  }

  TemporaryFile file_{"followed.pcap", ""};
  std::string path_ = file_.path();
  std::unique_ptr<FollowedLink> link_;
};

TEST_F(FollowedLinkTest, ReadsOnAsTheFileGrowsWhereverItEnds) {
  const std::string bytes = capture_bytes({received({0x52, 1, 0, 0, 0}), received({0x52, 2, 0, 0, 0})});
  link_ = FollowedLink::open(path_).value();
  std::size_t frames = 0;
  for (const char byte : bytes) {
    append(std::string(1, byte));
    if (const Result<LinkFrame> frame = link_->receive({}); frame)
      EXPECT_EQ(frame->packet()[1], ++frames);
    else
      EXPECT_EQ(frame.error().code, ErrorCode::kTimeout) << frame.error().message;
  }
  EXPECT_EQ(frames, 2U);
}

TEST_F(FollowedLinkTest, FollowsTheVehicleThatSendsLogDataFirst) {
  append(capture_bytes({sent({0xFF})}, radio_vehicle(0x01)));  // of a scan
  link_ = FollowedLink::open(path_).value();
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kTimeout);
  const auto add = [this](const Bytes& packet, std::uint8_t vehicle) {
    append(capture_bytes({received(packet)}, radio_vehicle(vehicle)).substr(kPcapFileHeader));
  };
  add({0x5D, 5, 0, 0}, 0x02);
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kTimeout);
  add({0x52, 1, 0, 0, 0}, 0x02);
  add({0x52, 2, 0, 0, 0}, 0x03);
  add({0x52, 3, 0, 0, 0}, 0x02);
  EXPECT_EQ(next(), (Bytes{0x5D, 5, 0, 0}));
  EXPECT_EQ(next(), (Bytes{0x52, 1, 0, 0, 0}));
  EXPECT_EQ(next(), (Bytes{0x52, 3, 0, 0, 0}));
  EXPECT_EQ(next(), Bytes{});
}

TEST_F(FollowedLinkTest, AFifoIsReadUntilItsWriterClosesIt) {
  const std::string bytes = capture_bytes({received({0x52, 1, 0, 0, 0})});
  std::filesystem::remove(path_);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  link_ = FollowedLink::open(path_).value();
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kTimeout) << "nobody writes yet";
  const int writer = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  EXPECT_EQ(::write(writer, bytes.data(), 30), 30);
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kTimeout);
  EXPECT_EQ(::write(writer, bytes.data() + 30, bytes.size() - 30), std::ssize(bytes) - 30);
  EXPECT_EQ(next(), (Bytes{0x52, 1, 0, 0, 0}));
  ::close(writer);
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kEndOfRecording);
}

/// No file of this process may grow beyond a size while this lives: as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, handler_before_));
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_before_)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before_{};
};

TEST_F(FollowedLinkTest, SaysThatTheDiskIsFullAfterThePacketsThatItKept) {
  const std::string bytes = capture_bytes({received({0x52, 1, 0, 0, 0}), received({0x52, 2, 0, 0, 0})});
  std::filesystem::remove(path_);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  link_ = FollowedLink::open(path_).value();
  const int writer = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_EQ(::write(writer, bytes.data(), bytes.size()), std::ssize(bytes));
  {
    const FileSizeLimit limit(bytes.size() - 1);
    EXPECT_EQ(next(), (Bytes{0x52, 1, 0, 0, 0}));
    for (int i = 0; i < 2; ++i) {
      const Result<LinkFrame> frame = link_->receive(milliseconds(50));
      ASSERT_FALSE(frame.ok());
      EXPECT_EQ(frame.error().code, ErrorCode::kOutOfSpace) << frame.error().message;
      EXPECT_TRUE(frame.error().message.starts_with(path_)) << frame.error().message;
    }
  }
  ::close(writer);
}

TEST_F(FollowedLinkTest, SaysWhatIsNoCapture) {
  append("this is certainly not a capture of anything");
  link_ = FollowedLink::open(path_).value();
  EXPECT_EQ(code_of(link_->receive({})), ErrorCode::kInvalidInput);
  EXPECT_EQ(FollowedLink::open(path_ + "_no").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(FollowedLink::open("/dev").error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace swiftlet
