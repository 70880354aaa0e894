// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/geometry/stamped_pose.hpp"
#include "core/sensing/mended_odometry.hpp"
#include "core/sensing/sensor_model.hpp"
#include "firmware_link/link/frame_sink.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/sample/input_counters.hpp"
#include "firmware_link/sample/received_sample.hpp"
#include "firmware_link/session/live_status.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

/// The report of an input on itself; copied into report.json and the status message.
struct InputReport {
  InputCounters counters;
  std::vector<std::string> notes;     ///< remarks (e.g. layout taken from a side file)
  std::vector<std::string> problems;  ///< what went wrong, one line each, with the byte offset or line number
  bool shows_age =
      true;  ///< false: scan and pose come in one line with one stamp, which has no age of its own
  std::vector<double> storey_levels_m;  ///< of the storeys that were flown, by id, above the first; of a
                                        ///< climb that was given up its end
  double reversed_m = 0.0;  ///< way that the odometry reported as forward, taken as driven in reverse
};

/// A source of range samples in time order: a link with its log session and assembler, or a laser log. One
/// thread at a time.
class SampleSource {
 public:
  SampleSource() = default;
  virtual ~SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;

  /// The next sample. Errors: kEndOfRecording at the end, also where damage ended it early (then
  /// report().problems names it); kTimeout: nothing now, call again; anything else is final.
  [[nodiscard]] virtual Result<ReceivedSample> next() = 0;
  [[nodiscard]] virtual const BeamLayout& beams() const = 0;
  /// The sensor model of this input, unless the configuration overrides it.
  [[nodiscard]] virtual const SensorModel& sensor() const = 0;
  [[nodiscard]] virtual const InputReport& report() const = 0;
  /// The share of the input that was read, 0 to 1; nullopt when the end is unknown.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }
  /// Whether it is a vehicle, which cannot wait: samples come in real time, without end.
  [[nodiscard]] virtual bool is_live() const { return false; }
  /// The state of the link and the vehicle; nullopt for recordings and laser logs.
  [[nodiscard]] virtual std::optional<LiveStatus> live_status() const { return std::nullopt; }
  /// The next event of the vehicle or its link.
  [[nodiscard]] virtual std::optional<VehicleEvent> take_event() { return std::nullopt; }
  /// The same input from its beginning, as it was reported, with another age of the ranges (nullopt: the
  /// sensor model's), if that takes no second reading; else null.
  [[nodiscard]] virtual std::unique_ptr<SampleSource> again(std::optional<Duration> /*range_age*/) const {
    return nullptr;
  }
  /// No more samples will be taken: events become notes in report() now. Allocates.
  virtual void end() {}
  /// T_world_body at every sample delivered so far, stamped like the sample; empty if the truth is unknown.
  [[nodiscard]] virtual std::vector<StampedPose> ground_truth() const { return {}; }
  /// Where the dead reckoning of the samples delivered so far is not as reported.
  [[nodiscard]] virtual std::vector<MendedOdometry> mended() const { return {}; }
};

/// The note of an input whose beams are as they are, where beam_count is asked for.
inline constexpr const char* kBeamsIgnored =
    "the number of beams is the sensor's own here; --beams is ignored";

struct SampleSourceOptions {
  std::optional<int> beam_count;      ///< laser logs: how many beams to keep (default 11); 2..kMaxBeams
  std::optional<Duration> range_age;  ///< overrides the sensor model's
  std::optional<double> max_range_m;  ///< overrides the sensor model's
  std::optional<double> min_range_m;  ///< overrides the sensor model's
  FrameSink* recording = nullptr;     ///< links only: receives every frame; must outlive the source
  bool mends_motion = true;           ///< by MotionMendingSource; false: as reported
  bool may_follow = false;            ///< whether a recording that is still written may be followed
  std::optional<UdpAddress> share;    ///< vehicles only: where a client that shares the link connects
};

}  // namespace swiftlet
