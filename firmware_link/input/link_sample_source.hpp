// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/fixed_vector.hpp"
#include "firmware_link/file/pose_file.hpp"
#include "firmware_link/link/frame_sink.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/link/usb_device.hpp"
#include "firmware_link/sample/landed_odometry_freeze.hpp"
#include "firmware_link/sample/reading_extractor.hpp"
#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/sample/sample_source.hpp"
#include "firmware_link/session/block_description.hpp"
#include "firmware_link/session/live_session.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "firmware_link/session/vehicle_event.hpp"
#include "firmware_link/sharing/shared_link.hpp"

namespace swiftlet {

/// The true poses of a simulated vehicle, and the file that keeps them.
struct KnownTruth {
  std::function<Pose2(DeviceTime)> T_world_body_at;
  PoseFile kept;
};

/// The parts of a LinkSampleSource.
struct LinkInput {
  std::string name;  ///< for messages: path or URI
  std::shared_ptr<LinkClock>
      clock;                        ///< of a live link; without a clock the stamps of the frames are the time
  std::shared_ptr<UsbBus> usb_bus;  ///< used by the link, or nullptr
  std::unique_ptr<Link> link;
  SharedLink* shared = nullptr;  ///< the link, if a client may share it
  SensorModel sensor = SensorModel::crazyflie();
  bool starts_logging = false;            ///< request the log from the vehicle; otherwise only receive
  std::filesystem::path cache_directory;  ///< of tables of contents; empty: kept in memory only
  FrameSink* recording = nullptr;         ///< receives every frame too; must outlive the source
  std::optional<BlockDescription> description;
  std::vector<std::string> notes;
  std::function<std::optional<double>()> progress;  ///< may be empty
  std::optional<KnownTruth> truth;
};

/// Range samples from a vehicle, live or recorded: link, log session and assembler in one. One thread at a
/// time. next() allocates nothing once samples flow and the inventory of a live vehicle is known, some
/// seconds later, until it has to reconnect or the recording ends.
class LinkSampleSource final : public SampleSource {
 public:
  explicit LinkSampleSource(LinkInput input);

  /// For recordings: reads up to the first sample, which next() then delivers. Errors: kInvalidInput: there
  /// is none; the message gives the reason. kDamaged: damaged before the first sample.
  [[nodiscard]] Status find_first_sample();

  [[nodiscard]] Result<ReceivedSample> next() override;
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return input_.sensor; }
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::optional<double> progress() const override;
  [[nodiscard]] bool is_live() const override { return input_.clock != nullptr; }
  [[nodiscard]] std::optional<LiveStatus> live_status() const override;
  [[nodiscard]] std::optional<VehicleEvent> take_event() override;
  /// Events that are warnings become notes, the first of each kind; what log packets and dead reckoning lack,
  /// too.
  void end() override;
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override;

 private:
  Result<ReceivedSample> read_sample();
  [[nodiscard]] MonotonicTime arrived_at() const;
  /// Processes one frame.
  Status step();
  Status send_request();
  void on_frame(const LinkFrame& frame);
  void on_cached_toc(HostTime at);
  Status answer_failure(const Error& error, Duration waited);
  void follow_periods();
  void finish_report();
  void note_breaks();
  [[nodiscard]] std::string explain_no_samples() const;

  LinkInput input_;
  BeamLayout beams_ = BeamLayout::multiranger();
  InputReport report_;
  LogSession session_;
  TocCache cache_;
  std::optional<LiveSession> live_;
  FixedVector<VehicleEvent, 16> noted_;  ///< warnings, the first of each kind
  ReadingExtractor extractor_;
  LandedOdometryFreeze ground_;
  SampleAssembler assembler_;
  Duration range_period_{};     ///< 0: unknown
  Duration odometry_period_{};  ///< likewise
  HostTime now_{};
  HostTime received_at_{};  // the last frame from the vehicle
  std::optional<Error> end_;
  bool report_is_finished_ = false;
  std::optional<ReceivedSample> first_sample_;
};

}  // namespace swiftlet
