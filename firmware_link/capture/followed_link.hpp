// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "firmware_link/capture/capture_reader.hpp"
#include "firmware_link/capture/minute_stamps.hpp"
#include "firmware_link/link/link.hpp"

namespace swiftlet {

/// A capture that another program is still writing: a file, from its beginning and on as it grows, or a FIFO,
/// until its writer closes it. Both directions of one vehicle, that whose log data comes first; nothing
/// before that has come. One thread at a time; allocates.
class FollowedLink final : public Link {
 public:
  /// The file may be empty yet. Errors: kNotFound: no such file. kInvalidInput: it cannot be read.
  [[nodiscard]] static Result<std::unique_ptr<FollowedLink>> open(const std::string& path);
  ~FollowedLink() override;

  /// Errors: kTimeout: nothing was written meanwhile, or no log data yet. kEndOfRecording: the writer of the
  /// FIFO has closed it. kInvalidInput: no capture. kDamaged: as CaptureReader's. kOutOfSpace: the disk of
  /// temporary files is full, which keeps what comes out of a FIFO; the packets kept before come first.
  [[nodiscard]] Result<LinkFrame> receive(Duration timeout) override;
  /// Does nothing: a recording does not answer.
  [[nodiscard]] Status send(std::span<const std::uint8_t> /*packet*/) override { return {}; }

 private:
  FollowedLink(std::string path, int file) : path_(std::move(path)), file_(file) {}
  [[nodiscard]] Result<LinkFrame> read_frame();
  [[nodiscard]] Status open_capture();
  [[nodiscard]] Status choose_vehicle();
  void take_from_fifo();
  void fail();
  void wait(Duration duration) const;

  std::string name_;           // of the FIFO, for messages
  std::string path_;           // of what is read: the file, or what came out of the FIFO
  int file_ = -1;              // of the FIFO; -1: not one
  std::FILE* kept_ = nullptr;  // what came out of it
  bool fifo_has_begun_ = false;
  bool fifo_has_ended_ = false;
  std::optional<Error> failure_;  // of kept_
  std::optional<CaptureReader> reader_;
  std::optional<CaptureVehicle> followed_;
  std::optional<MinuteStamps> stamps_;  // if its stamps may be of that kind
};

}  // namespace swiftlet
