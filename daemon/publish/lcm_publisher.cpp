// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_publisher.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/base/check.hpp"
#include "daemon/publish/channel_names.hpp"
#include "daemon/publish/mbot_publisher.hpp"
#include "daemon/publish/message_parts.hpp"
#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_info_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"

namespace swiftlet {
namespace {

void copy_point(const Point2& from, double (&to)[2]) {
  to[0] = from.x_m;
  to[1] = from.y_m;
}
void copy_point(const Point2& from, float (&to)[2]) {
  to[0] = static_cast<float>(from.x_m);
  to[1] = static_cast<float>(from.y_m);
}

// The types hold signed numbers only; no count of a run comes near their end.
template <typename T>
std::int64_t i64(T value) {
  return static_cast<std::int64_t>(value);
}
template <typename T>
std::int32_t i32(T value) {
  return static_cast<std::int32_t>(value);
}

void fill_input(const InputStatus& input, status_t& message) {
  const InputCounters& counters = input.counters;
  message.progress = input.progress;
  message.frames = i64(counters.frames);
  message.samples = i64(counters.samples);
  message.gaps = i64(counters.gaps);
  message.missing_packets = i64(counters.missing_packets);
  message.duplicates = i64(counters.duplicates);
  message.out_of_order = i64(counters.out_of_order);
  message.unpaired = i64(counters.unpaired);
  message.segments = i64(counters.segments);
  message.input_problems = i64(input.problems);
}

std::int8_t condition_code(LinkCondition condition) {
  switch (condition) {
    case LinkCondition::kNone:
      return link_status_t::CONDITION_NONE;
    case LinkCondition::kConnected:
      return link_status_t::CONDITION_CONNECTED;
    case LinkCondition::kSilent:
      return link_status_t::CONDITION_SILENT;
    case LinkCondition::kDeviceMissing:
      return link_status_t::CONDITION_DEVICE_MISSING;
    case LinkCondition::kAccessDenied:
      return link_status_t::CONDITION_ACCESS_DENIED;
    case LinkCondition::kDeviceBusy:
      return link_status_t::CONDITION_DEVICE_BUSY;
    case LinkCondition::kDeviceStalls:
      return link_status_t::CONDITION_DEVICE_STALLS;
    case LinkCondition::kDeviceOverflows:
      return link_status_t::CONDITION_DEVICE_OVERFLOWS;
    case LinkCondition::kDeviceMute:
      return link_status_t::CONDITION_DEVICE_MUTE;
    case LinkCondition::kDeviceFault:
      return link_status_t::CONDITION_DEVICE_FAULT;
    case LinkCondition::kDeviceUnsuited:
      return link_status_t::CONDITION_DEVICE_UNSUITED;
  }
  return link_status_t::CONDITION_NONE;
}

void fill_link(const LiveStatus& live, const LinkRates& rates, link_status_t& message) {
  message.condition = condition_code(live.link.condition);
  message.safelink = live.link.safelink ? 1 : 0;
  message.ack_rate = rates.ack_rate;
  message.retries_per_packet = rates.retries_per_packet;
  message.sent_rate = rates.sent_hz;
  message.received_rate = rates.received_hz;
  message.round_trip_ms = live.round_trip > Duration::zero() ? to_seconds(live.round_trip) * 1e3 : -1.0;
  message.rssi_dbm = live.vehicle.rssi_dbm.value_or(0);
  message.battery_v = live.vehicle.battery_mv.value_or(0) * 1e-3;
  message.flying = static_cast<std::int8_t>(live.vehicle.is_flying ? (*live.vehicle.is_flying ? 1 : 0) : -1);
  message.packets_sent = i64(live.link.packets_sent);
  message.packets_acked = i64(live.link.packets_acked);
  message.packets_received = i64(live.link.packets_received);
  message.duplicates = i64(live.link.duplicates);
  message.silences = i64(live.link.silences);
  message.device_losses = i64(live.link.device_losses);
  message.usb_timeouts = i64(live.link.usb_timeouts);
  message.client = static_cast<std::int8_t>(live.sharing.is_shared ? (live.sharing.has_client ? 1 : 0) : -1);
  message.client_setpoints_dropped = i64(live.sharing.counters.steering_dropped);
  message.client_requests_dropped = i64(live.sharing.counters.requests_dropped);
}

void fill_counters(const DaemonStatus& status, status_t& message) {
  message.keyframes = i64(status.frontend.keyframes);
  message.batches_rolled_back = i64(status.frontend.batches_rolled_back);
  message.submaps = i64(status.backend.submaps);
  message.closures_accepted = i64(status.backend.closures_accepted);
  message.closures_dropped = i64(status.backend.closures_dropped);
  message.optimizations = i64(status.backend.optimizations);
  message.solver_failures = i64(status.backend.solver_failures);
  message.tile_count = i32(status.map.tiles);
  message.version_sum = i64(status.map.version_sum);
}

std::int8_t status_code(RangeStatus status) {
  switch (status) {
    case RangeStatus::kHit:
      return ranges_t::STATUS_HIT;
    case RangeStatus::kNoReturn:
      return ranges_t::STATUS_NO_RETURN;
    case RangeStatus::kInvalid:
      break;
  }
  return ranges_t::STATUS_INVALID;
}

std::int8_t tracking_code(Tracking tracking) {
  switch (tracking) {
    case Tracking::kTracking:
      return pose_t::TRACKING_GOOD;
    case Tracking::kUncertain:
      return pose_t::TRACKING_UNCERTAIN;
    case Tracking::kLost:
      return pose_t::TRACKING_LOST;
    case Tracking::kRelocalizing:
      break;
  }
  return pose_t::TRACKING_RELOCALIZING;
}

void fill_tracking(const TrackingFigures& figures, tracking_t& message) {
  message.state = tracking_code(figures.tracking);
  message.contradiction = figures.contradiction;
  message.contradicting_share = figures.contradicting_share;
  message.returns_compared = i64(figures.returns_compared);
  message.times_uncertain = i64(figures.times_uncertain);
  message.places_weighed = i32(figures.places_weighed);
  message.place_lead = figures.place_lead;
  message.innovation = figures.innovation;
  message.way_since_agreement = figures.way_since_agreement_m;
  message.way_since_closure = figures.way_since_closure_m;
  message.way_unplaced = figures.way_unplaced_m;
}

void copy_covariance(const Covariance3& from, double (&to)[6]) {
  const std::array<double, 6> values{from.xx, from.xy, from.x_yaw, from.yy, from.y_yaw, from.yaw_yaw};
  std::copy(values.begin(), values.end(), to);
}

void fill_queues(std::span<const QueueStatistics> queues, status_t& message) {
  message.queues.clear();
  for (const QueueStatistics& queue : queues) {
    queue_status_t& out = message.queues.emplace_back();
    out.name = queue.name;
    out.capacity = i32(queue.capacity);
    out.high_water = i32(queue.high_water);
    out.refused = i64(queue.refused);
  }
  message.queue_count = i32(message.queues.size());
}

void fill_stages(std::span<const StageSummary> stages, status_t& message) {
  message.stages.clear();
  for (const StageSummary& stage : stages) {
    stage_time_t& out = message.stages.emplace_back();
    out.name = stage.name;
    out.count = i64(stage.count);
    out.mean = stage.mean_ms;
    out.p50 = stage.p50_ms;
    out.p99 = stage.p99_ms;
    out.p999 = stage.p999_ms;
    out.max = stage.max_ms;
  }
  message.stage_count = i32(message.stages.size());
}

std::int8_t storey_code(StoreyId storey) {
  static_assert(kMaxStoreys <= 127);
  return static_cast<std::int8_t>(index_of(storey));
}

std::int8_t recording_code(RecordingState state) {
  switch (state) {
    case RecordingState::kNone:
      return status_t::RECORDING_NONE;
    case RecordingState::kRunning:
      return status_t::RECORDING_RUNNING;
    case RecordingState::kFailed:
      break;
  }
  return status_t::RECORDING_FAILED;
}

std::int8_t state_code(DaemonState state) {
  switch (state) {
    case DaemonState::kRunning:
      return status_t::STATE_RUNNING;
    case DaemonState::kFinishing:
      return status_t::STATE_FINISHING;
    case DaemonState::kFinished:
      break;
  }
  return status_t::STATE_FINISHED;
}

class LcmPublisher final : public Publisher {
 public:
  LcmPublisher(MessageSink sink, const std::string& prefix, std::int64_t map_id)
      : sink_(std::move(sink)),
        map_id_(map_id),
        pose_map_(prefix + kPoseChannel),
        pose_local_(prefix + kPoseLocalChannel),
        pose_odom_(prefix + kPoseOdomChannel),
        pose2d_map_(prefix + kPose2dChannel),
        pose2d_odom_(prefix + kPoseOdom2dChannel),
        ranges_(prefix + kRangesChannel),
        map_info_(prefix + kMapInfoChannel),
        map_tile_(prefix + kMapTileChannel),
        landmarks_(prefix + kLandmarksChannel),
        loop_closure_(prefix + kLoopClosureChannel),
        vehicle_event_(prefix + kVehicleEventChannel),
        status_(prefix + kStatusChannel) {}

  void publish_pose(const PoseUpdate& pose) override;
  void publish_tile(HostTime now, const MapTile& tile, double resolution_m) override;
  void publish_map(HostTime now, const MapSummary& map) override;
  void publish_walls(HostTime now, std::span<const WallInMap> walls) override;
  void publish_closure(HostTime now, const ClosureUpdate& update) override;
  void publish_event(HostTime now, const VehicleEvent& event) override;
  void publish_status(HostTime now, const DaemonStatus& status) override;

 private:
  template <typename Message>
  void send(const std::string& channel, const Message& message) {
    // The datagram also holds the channel's name.
    const std::size_t room = kMaxLcmMessageBytes - channel.size() - 1;
    const int bytes = message.encode(buffer_.data(), 0, static_cast<int>(room));
    SWIFTLET_CHECK(bytes > 0, "a message fits one datagram by construction");
    if (sink_(channel, std::span(buffer_).first(static_cast<std::size_t>(bytes)))) return;
    if (!std::exchange(has_failed_, true))
      spdlog::error("LCM did not take a message on {}: {}{}", channel, std::strerror(errno),
                    errno == ENOTCONN ? "; start its server, which is looked for until it answers" : "");
  }
  void send_pose(const std::string& channel, std::int8_t frame, const Pose2& pose, const PoseUpdate& update);
  void send_ranges(const PoseUpdate& update);

  MessageSink sink_;
  std::int64_t map_id_;
  // Channels.
  const std::string pose_map_, pose_local_, pose_odom_, pose2d_map_, pose2d_odom_, ranges_, map_info_,
      map_tile_, landmarks_, loop_closure_, vehicle_event_, status_;
  // Kept from message to message for their storage.
  ranges_t ranges_message_;
  map_tile_t tile_message_;
  landmarks_t landmarks_message_;
  status_t status_message_;
  std::array<std::uint8_t, kMaxLcmMessageBytes> buffer_;
  bool has_failed_ = false;
};

void LcmPublisher::send_pose(const std::string& channel, std::int8_t frame, const Pose2& pose,
                             const PoseUpdate& update) {
  pose_t message;
  message.utime = to_utime(update.stamp);
  message.map_id = map_id_;
  message.sequence = i32(update.sequence);
  message.segment = i32(update.segment);
  message.keyframe = i32(index_of(update.keyframe));
  message.correction_version = i32(update.correction_version);
  message.correction = update.correction_m;
  message.frame = frame;
  message.x = pose.x_m();
  message.y = pose.y_m();
  message.yaw = pose.yaw_rad();
  message.storey = storey_code(update.storey);
  message.tracking = tracking_code(update.tracking);
  const bool is_map = frame == pose_t::FRAME_MAP;
  copy_covariance(is_map ? update.from_surroundings : Covariance3{}, message.covariance_map);
  copy_covariance(is_map ? update.from_start : Covariance3{}, message.covariance_start);
  send(channel, message);
}

void LcmPublisher::send_ranges(const PoseUpdate& update) {
  const BeamReadings& beams = update.beams;
  ranges_t& message = ranges_message_;
  message.utime = to_utime(update.stamp);
  message.map_id = map_id_;
  message.sequence = i32(update.sequence);
  message.device_utime =
      std::chrono::duration_cast<std::chrono::microseconds>(update.measured_at.time_since_epoch()).count();
  message.max_range = beams.max_range_m;
  message.count = beams.count;
  message.bearing.assign(beams.bearing_rad.begin(), beams.bearing_rad.begin() + beams.count);
  message.distance.assign(beams.distance_m.begin(), beams.distance_m.begin() + beams.count);
  message.status.resize(beams.count);
  std::transform(beams.status.begin(), beams.status.begin() + beams.count, message.status.begin(),
                 status_code);
  send(ranges_, message);
}

void LcmPublisher::publish_pose(const PoseUpdate& pose) {
  send_pose(pose_map_, pose_t::FRAME_MAP, pose.T_map_body, pose);
  send_pose(pose_local_, pose_t::FRAME_LOCAL, pose.T_local_body, pose);
  send_ranges(pose);
  send_pose(pose_odom_, pose_t::FRAME_ODOM, pose.T_odom_body, pose);
  send(pose2d_map_, pose2d_message(pose.stamp, pose.T_map_body));
  send(pose2d_odom_, pose2d_message(pose.stamp, pose.T_odom_body));
}

void LcmPublisher::publish_tile(HostTime now, const MapTile& tile, double resolution_m) {
  map_tile_t& message = tile_message_;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.tile_x = tile.index.x;
  message.tile_y = tile.index.y;
  message.storey = storey_code(tile.index.storey);
  message.version = i32(tile.version);
  message.resolution = resolution_m;
  static_assert(sizeof(message.occupancy_percent) == sizeof(tile.occupancy_percent));
  std::memcpy(message.occupancy_percent, tile.occupancy_percent.data(), sizeof(message.occupancy_percent));
  send(map_tile_, message);
}

void LcmPublisher::publish_map(HostTime now, const MapSummary& map) {
  map_info_t message;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.resolution = map.resolution_m;
  message.tile_cells = kTileCells;
  message.tile_count = i32(map.tiles);
  message.version_sum = i64(map.version_sum);
  message.tile_min[0] = map.lowest.x;
  message.tile_min[1] = map.lowest.y;
  message.tile_max[0] = map.highest.x;
  message.tile_max[1] = map.highest.y;
  send(map_info_, message);
}

void LcmPublisher::publish_walls(HostTime now, std::span<const WallInMap> walls) {
  landmarks_t& message = landmarks_message_;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.total = i32(walls.size());
  std::size_t first = 0;
  do {  // also where there are none
    const auto part = walls.subspan(first, std::min(kMaxWallsPerMessage, walls.size() - first));
    message.first = i32(first);
    message.count = i32(part.size());
    message.landmarks.resize(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
      message.landmarks[i].id = i32(index_of(part[i].id));
      message.landmarks[i].storey = storey_code(part[i].storey);
      copy_point(part[i].start_map, message.landmarks[i].start);
      copy_point(part[i].end_map, message.landmarks[i].end);
    }
    send(landmarks_, message);
    first += part.size();
  } while (first < walls.size());
}

void LcmPublisher::publish_closure(HostTime now, const ClosureUpdate& update) {
  const LoopClosure& closure = update.closure;
  loop_closure_t message;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.index = i32(index_of(closure.id));
  message.from_keyframe = i32(index_of(closure.from));
  message.to_keyframe = i32(index_of(closure.to));
  message.x = closure.T_from_to.x_m();
  message.y = closure.T_from_to.y_m();
  message.yaw = closure.T_from_to.yaw_rad();
  message.sigma_x = std::sqrt(closure.covariance.xx);
  message.sigma_y = std::sqrt(closure.covariance.yy);
  message.sigma_yaw = std::sqrt(closure.covariance.yaw_yaw);
  message.score = closure.score;
  message.dcs_scale = closure.dcs_scale;
  message.dropped = static_cast<std::int8_t>(closure.dropped ? 1 : 0);
  message.storey = storey_code(update.storey);
  copy_point(update.from_map, message.from_map);
  copy_point(update.to_map, message.to_map);
  send(loop_closure_, message);
}

void LcmPublisher::publish_event(HostTime now, const VehicleEvent& event) {
  using enum VehicleEvent::Kind;
  if (event.kind == kBatteryLow || event.kind == kDataStopped) return;  // told by status, and by segments
  vehicle_event_t message;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.text = describe(event);
  send(vehicle_event_, message);
}

void LcmPublisher::publish_status(HostTime now, const DaemonStatus& status) {
  status_t& message = status_message_;
  message.utime = to_utime(now);
  message.map_id = map_id_;
  message.state = state_code(status.state);
  message.sample_rate = status.sample_rate_hz;
  fill_input(status.input, message);
  fill_link(status.input.live, status.link_rates, message.link);
  fill_tracking(status.tracking, message.tracking);
  fill_counters(status, message);
  fill_queues(status.queues, message);
  fill_stages(status.stages, message);
  message.missed_deadlines = i64(status.missed_deadlines);
  message.recording = recording_code(status.recording.state);
  message.recorded_bytes = i64(status.recording.bytes);
  send(status_, message);
}

}  // namespace

std::unique_ptr<Publisher> make_lcm_publisher(LcmTransport& lcm, const std::string& channel_prefix,
                                              std::int64_t map_id, MessageSink also,
                                              Compatibility compatibility) {
  const MessageSink to_lcm = [&lcm](const std::string& channel, std::span<const std::uint8_t> message) {
    return lcm.publish(channel, message);
  };
  const auto sink = [to_lcm, also = std::move(also)](const std::string& channel,
                                                     std::span<const std::uint8_t> message) {
    const bool is_taken = to_lcm(channel, message);
    const int why = errno;
    if (also) static_cast<void>(also(channel, message));
    errno = why;
    return is_taken;
  };
  std::unique_ptr<Publisher> own = make_message_publisher(sink, channel_prefix, map_id);
  if (compatibility == Compatibility::kMbot) return make_mbot_publisher(std::move(own), to_lcm);
  return own;
}

std::unique_ptr<Publisher> make_message_publisher(MessageSink sink, const std::string& channel_prefix,
                                                  std::int64_t map_id) {
  return std::make_unique<LcmPublisher>(std::move(sink), channel_prefix, map_id);
}

}  // namespace swiftlet
