// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/link_sample_source.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/link/link_packet.hpp"
#include "firmware_link/sample/flight_assembly.hpp"

namespace swiftlet {
namespace {

constexpr Duration kReceiveTimeout = std::chrono::milliseconds(200);
constexpr Duration kTimeoutWhileAsking = RepeatTimer::kShortest;
// Frames that come without end, but hold nothing that samples need, must not block the caller, which looks
// whether it is to stop; who rests for a millisecond after each call still reads 100 000 of them a second.
constexpr int kMaxFramesAtOnce = 256;

}  // namespace

LinkSampleSource::LinkSampleSource(LinkInput input)
    : input_(std::move(input)),
      cache_(input_.cache_directory),
      extractor_(session_),
      assembler_(flight_assembly(input_.sensor), report_.counters) {
  report_.notes = input_.notes;
  if (input_.description) session_.describe(*input_.description);
  if (input_.starts_logging) live_.emplace(session_, cache_, input_.shared != nullptr);
  assembler_.set_periods(range_period_, odometry_period_);
}

Status LinkSampleSource::find_first_sample() {
  Result<ReceivedSample> received = read_sample();
  while (!received && received.error().code == ErrorCode::kTimeout) received = read_sample();
  if (received) {
    first_sample_ = *received;
    return {};
  }
  if (received.error().code != ErrorCode::kEndOfRecording) return received.error();
  if (!report_.problems.empty())
    return Error{ErrorCode::kDamaged, report_.problems.front() + "; it holds no sample"};
  return Error{ErrorCode::kInvalidInput, explain_no_samples()};
}

Result<ReceivedSample> LinkSampleSource::next() {
  Result<ReceivedSample> received = first_sample_ ? Result<ReceivedSample>(*first_sample_) : read_sample();
  first_sample_.reset();
  if (!received) return received;
  const RangeSample& sample = received->sample;
  if (live_) live_->on_odometry(sample.T_odom_body);
  if (input_.truth)
    input_.truth->kept.push_back({sample.stamp, input_.truth->T_world_body_at(sample.measured_at)});
  return received;
}

Result<ReceivedSample> LinkSampleSource::read_sample() {
  for (int frames = 0; frames < kMaxFramesAtOnce; ++frames) {
    if (const std::optional<RangeSample> sample = assembler_.take())
      return ReceivedSample{.sample = *sample, .arrived_at = arrived_at()};
    if (end_) return *end_;
    const Status stepped = step();
    if (!stepped) return stepped.error();
  }
  return Error{ErrorCode::kTimeout, "no sample yet"};  // short: not on the heap
}

Status LinkSampleSource::step() {
  if (live_) {
    Status sent = send_request();
    if (!sent) return sent;
  }
  const Duration timeout = live_ && live_->asks() ? kTimeoutWhileAsking : kReceiveTimeout;
  const Result<LinkFrame> frame = input_.link->receive(timeout);
  if (!frame) return answer_failure(frame.error(), timeout);
  now_ = std::max(now_, frame->at);
  on_frame(*frame);
  return {};
}

Status LinkSampleSource::send_request() {
  if (input_.clock) now_ = input_.clock->now();
  const std::optional<CrtpPacket> request = live_->next_request(now_);
  return request ? input_.link->send(bytes_of(*request)) : Status();
}

void LinkSampleSource::on_frame(const LinkFrame& frame) {
  ++report_.counters.frames;
  if (frame.direction == LinkDirection::kFromVehicle) received_at_ = frame.at;
  if (input_.recording != nullptr) input_.recording->take(frame);
  const std::optional<LogRecord> record = session_.on_frame(frame);
  if (live_ && frame.is_ours && frame.direction == LinkDirection::kFromVehicle) {
    live_->on_frame(frame, record);
    on_cached_toc(frame.at);
    if (live_->failure()) end_ = live_->failure();
  }
  if (!record) return;
  const std::optional<Reading> reading = extractor_.extract(*record);
  if (!reading) return;
  follow_periods();
  assembler_.add(ground_.hold(*reading));
}

/// A recording needs the names too, or it could not be replayed.
void LinkSampleSource::on_cached_toc(HostTime at) {
  for (const CrtpPacket& reply : live_->take_cached_replies()) {
    const LinkFrame frame = frame_of(LinkDirection::kFromVehicle, at, bytes_of(reply));
    if (input_.recording != nullptr) input_.recording->take(frame);
    static_cast<void>(session_.on_frame(frame));
  }
}

Status LinkSampleSource::answer_failure(const Error& error, Duration waited) {
  if (error.code == ErrorCode::kTimeout) {
    now_ += waited;  // with a clock, the next call corrects it
    return error;
  }
  assembler_.end();
  end_ = error;
  if (error.code == ErrorCode::kDamaged) {
    report_.problems.push_back(error.message);
    end_ = Error{ErrorCode::kEndOfRecording, error.message};
  }
  finish_report();
  return {};
}

void LinkSampleSource::follow_periods() {
  const bool finds_odometry = extractor_.finds_position() && extractor_.finds_yaw();
  const Duration range_period = extractor_.finds_ranges() ? extractor_.range_period() : range_period_;
  const Duration odometry_period = finds_odometry ? extractor_.odometry_period() : odometry_period_;
  if (range_period == range_period_ && odometry_period == odometry_period_) return;
  range_period_ = range_period;
  odometry_period_ = odometry_period;
  assembler_.set_periods(range_period, odometry_period);
}

/// What the log packets lacked, once: where the link ends by itself, or at the end of the run.
void LinkSampleSource::finish_report() {
  if (std::exchange(report_is_finished_, true)) return;
  if (session_.used_description() && !input_.description->source.empty())
    report_.notes.push_back("block layouts taken from " + input_.description->source +
                            ": the recording has no table of contents for them");
  for (const std::string& name : extractor_.missing_ranges())
    report_.notes.push_back(name + " is not logged beside the other ranges: that beam is always invalid");
  const UnreadableRecords& unreadable = session_.unreadable();
  if (unreadable.unknown_block > 0)
    report_.notes.push_back(std::to_string(unreadable.unknown_block) +
                            " log packets of blocks that nothing describes were left out");
  if (unreadable.misfit > 0)
    report_.problems.push_back(input_.name + ": " + std::to_string(unreadable.misfit) +
                               " log packets have another size than their block and were left out");
  if (input_.truth && !input_.truth->kept.is_complete())
    report_.notes.push_back("the truth is not known of every sample: the disk of temporary files was full");
}

void LinkSampleSource::note_breaks() {
  if (const std::uint64_t wrong = session_.unreadable().wrong_time; wrong > 0)
    report_.problems.push_back(input_.name + ": " + std::to_string(wrong) +
                               " log packets have a time that the vehicle's clock cannot show and were left "
                               "out: they are damaged, or of another program");
  const InputCounters& counters = report_.counters;
  if (counters.leaps > 0)
    report_.notes.push_back("the dead reckoning leaps " + std::to_string(counters.leaps) +
                            " times as no vehicle can fly (its estimator was reset, or a packet is damaged)");
  if (counters.too_far > 0)
    report_.problems.push_back(input_.name + ": the dead reckoning has run away, " +
                               std::to_string(counters.too_far) + " range packets lie more than " +
                               std::to_string(static_cast<int>(kMaxFromBeginningM)) +
                               " m from its beginning and were left out: check the Flow deck");
}

std::vector<StampedPose> LinkSampleSource::ground_truth() const {
  return input_.truth ? input_.truth->kept.read() : std::vector<StampedPose>{};
}

std::string LinkSampleSource::explain_no_samples() const {
  const UnreadableRecords& unreadable = session_.unreadable();
  const bool has_data = extractor_.finds_ranges() || extractor_.finds_position() || extractor_.finds_yaw();
  if (report_.counters.frames == 0) return input_.name + ": holds no packet and no row";
  if (!has_data && unreadable.unknown_block > 0)
    return input_.name +
           ": the contents of its log blocks are unknown (no table of contents, or not their creation); "
           "describe them in " +
           input_.name +
           ".toml: [[block]] id = 1, variables = [ { name = \"range.front\", type = \"uint16\" }, ... ]";
  if (!extractor_.finds_ranges())
    return input_.name +
           ": no range.front, range.left, range.back or range.right in its log packets; log them";
  if (!extractor_.finds_position())
    return input_.name +
           ": no position in its log packets; log stateEstimate.x and stateEstimate.y, both in one block";
  if (!extractor_.finds_yaw())
    return input_.name + ": no yaw in its log packets; log stateEstimate.yaw or stabilizer.yaw";
  return input_.name + ": ranges and dead reckoning never lie close enough in time to be paired (" +
         std::to_string(report_.counters.unpaired) + " range packets)";
}

/// The last frame from the vehicle is the one that completes a sample.
MonotonicTime LinkSampleSource::arrived_at() const {
  return input_.clock ? input_.clock->monotonic_time_of(received_at_) : MonotonicTime{};
}

std::optional<LiveStatus> LinkSampleSource::live_status() const {
  if (!live_) return std::nullopt;
  return LiveStatus{.link = input_.link->statistics(),
                    .round_trip = live_->round_trip(),
                    .vehicle = live_->health(),
                    .sharing = input_.shared == nullptr ? SharingStatus{} : input_.shared->sharing()};
}

std::optional<VehicleEvent> LinkSampleSource::take_event() {
  if (!live_) return std::nullopt;
  std::optional<VehicleEvent> event = live_->take_event();
  if (!event && input_.shared != nullptr) event = input_.shared->take_event();
  const auto is_of_its_kind = [&event](const VehicleEvent& other) { return other.kind == event->kind; };
  if (event && is_warning(*event) && std::none_of(noted_.begin(), noted_.end(), is_of_its_kind))
    static_cast<void>(noted_.try_push_back(*event));
  return event;
}

void LinkSampleSource::end() {
  for (const StoreyLevel& level : assembler_.storeys().levels())
    report_.storey_levels_m.push_back(level.above_first_m);
  if (input_.shared != nullptr) input_.shared->end_sharing();
  for (const VehicleEvent& event : noted_) report_.notes.push_back(describe(event));
  noted_.clear();
  finish_report();
  note_breaks();
}

std::optional<double> LinkSampleSource::progress() const {
  return input_.progress ? input_.progress() : std::nullopt;
}

}  // namespace swiftlet
