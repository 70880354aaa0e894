// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/capture/followed_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(10);

}  // namespace

Result<std::unique_ptr<FollowedLink>> FollowedLink::open(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::kNotFound : ErrorCode::kInvalidInput;
    return Error{code, path + ": " + std::strerror(errno)};
  }
  struct stat status {};
  const bool is_known = ::fstat(file, &status) == 0;
  if (is_known && S_ISFIFO(status.st_mode)) {
    std::unique_ptr<FollowedLink> link(new FollowedLink(path, file));
    link->kept_ = std::tmpfile();
    if (link->kept_ == nullptr)
      return Error{ErrorCode::kInvalidInput, path + ": no temporary file can be made in " P_tmpdir ": " +
                                                 std::strerror(errno) + "; make room there"};
    link->name_ = path;
    link->path_ = "/proc/self/fd/" + std::to_string(::fileno(link->kept_));
    return link;
  }
  ::close(file);
  if (!is_known || !S_ISREG(status.st_mode))
    return Error{ErrorCode::kInvalidInput,
                 path + ": neither a file nor a FIFO; name the capture that is being written"};
  return std::unique_ptr<FollowedLink>(new FollowedLink(path, -1));
}

FollowedLink::~FollowedLink() {
  if (file_ >= 0) ::close(file_);
  if (kept_ != nullptr) std::fclose(kept_);
}

Result<LinkFrame> FollowedLink::receive(Duration timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    if (file_ >= 0 && !failure_) take_from_fifo();
    const bool has_ended = fifo_has_ended_;
    Result<LinkFrame> frame = read_frame();
    if (frame || frame.error().code != ErrorCode::kTimeout) return frame;
    if (failure_) return *failure_;
    if (has_ended) return Error{ErrorCode::kEndOfRecording, "the writer has closed the FIFO"};
    const auto left = std::chrono::duration_cast<Duration>(deadline - std::chrono::steady_clock::now());
    if (left <= Duration::zero()) return frame;
    wait(std::min(left, kLookEvery));
  }
}

Result<LinkFrame> FollowedLink::read_frame() {
  if (const Status opened = open_capture(); !opened) return opened.error();
  if (const Status chosen = choose_vehicle(); !chosen) return chosen.error();
  for (;;) {
    Result<CaptureRecord> record = reader_->next();
    if (!record) return record.error();
    if (record->vehicle != *followed_) continue;
    if (stamps_) record->frame.at = stamps_->unwrap(record->frame);
    return record->frame;
  }
}

Status FollowedLink::open_capture() {
  if (reader_) return {};
  std::error_code failure;
  if (std::filesystem::file_size(path_, failure) < kPcapFileHeader || failure)
    return Error{ErrorCode::kTimeout, "no packet"};
  Result<CaptureReader> reader = CaptureReader::open(path_);
  if (!reader) return reader.error();
  reader_ = std::move(reader).value();
  reader_->follow();
  return {};
}

/// A scan before the flight leaves records of addresses that nobody has.
Status FollowedLink::choose_vehicle() {
  while (!followed_) {
    const Result<CaptureRecord> record = reader_->next();
    if (!record) return record.error();
    const LinkFrame& frame = record->frame;
    if (frame.direction != LinkDirection::kFromVehicle || !is_on(frame.packet(), kLogDataTopic)) continue;
    followed_ = record->vehicle;
    if (MinuteStamps::may_be(frame.at)) stamps_.emplace();
    reader_->rewind();
  }
  return {};
}

void FollowedLink::take_from_fifo() {
  std::array<char, 65536> bytes{};
  for (;;) {
    const ssize_t size = ::read(file_, bytes.data(), bytes.size());
    if (size <= 0) {
      fifo_has_ended_ = size == 0 && fifo_has_begun_;  // before the first byte, its writer has not come yet
      break;
    }
    fifo_has_begun_ = true;
    const auto taken = static_cast<std::size_t>(size);
    if (std::fwrite(bytes.data(), 1, taken, kept_) != taken) return fail();
  }
  if (std::fflush(kept_) != 0) fail();
}

void FollowedLink::fail() {
  failure_ =
      Error{ErrorCode::kOutOfSpace, name_ + ": what came out of it could not be kept in " P_tmpdir ": " +
                                        std::strerror(errno) + "; make room there"};
}

void FollowedLink::wait(Duration duration) const {
  // A FIFO without a writer is readable, and empty.
  if (!fifo_has_begun_) return std::this_thread::sleep_for(duration);
  pollfd watched{.fd = file_, .events = POLLIN, .revents = 0};
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(duration);
  static_cast<void>(::poll(&watched, 1, static_cast<int>(left.count())));
}

}  // namespace swiftlet
