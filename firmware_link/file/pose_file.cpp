// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/file/pose_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>

namespace swiftlet {
namespace {

constexpr std::size_t kStreamBufferSize = 65'536;

/// The layout in the file, which only this process reads.
struct Record {
  std::int64_t stamp_ns;
  double x_m;
  double y_m;
  double yaw_rad;
};

}  // namespace

Result<PoseFile> PoseFile::open() {
  std::FILE* file = std::tmpfile();
  if (file != nullptr) return PoseFile(file);
  const std::error_code failure(errno, std::generic_category());
  return Error{ErrorCode::kInvalidInput, std::string("no temporary file can be made in " P_tmpdir ": ") +
                                             failure.message() + "; make room there"};
}

/// With its own buffer: else the first write would allocate one.
PoseFile::PoseFile(std::FILE* file) : buffer_(std::make_unique<char[]>(kStreamBufferSize)), file_(file) {
  static_cast<void>(std::setvbuf(file, buffer_.get(), _IOFBF, kStreamBufferSize));
}

void PoseFile::push_back(const StampedPose& pose) {
  const Record record{pose.stamp.time_since_epoch().count(), pose.pose.x_m(), pose.pose.y_m(),
                      pose.pose.yaw_rad()};
  failed_ |= std::fwrite(&record, sizeof record, 1, file_.get()) != 1;
}

std::vector<StampedPose> PoseFile::read() const {
  std::vector<StampedPose> poses;
  std::rewind(file_.get());  // writes what is still in the buffer
  for (Record record{}; std::fread(&record, sizeof record, 1, file_.get()) == 1;)
    poses.push_back({HostTime(Duration(record.stamp_ns)), Pose2(record.x_m, record.y_m, record.yaw_rad)});
  static_cast<void>(std::fseek(file_.get(), 0, SEEK_END));
  return poses;
}

}  // namespace swiftlet
