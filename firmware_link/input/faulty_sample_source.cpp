// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/faulty_sample_source.hpp"

#include <utility>

#include "core/base/settings.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

/// Whether samples are lost while the fault lasts.
bool hides_samples(MotionFaultKind kind) {
  return kind == MotionFaultKind::kSilence || kind == MotionFaultKind::kCarried ||
         kind == MotionFaultKind::kTeleport;
}

bool turns(MotionFaultKind kind) {
  return kind == MotionFaultKind::kYawJump || kind == MotionFaultKind::kYawTurn;
}

/// Whether the stamps show that samples are lost.
bool is_gap(MotionFaultKind kind) {
  return kind == MotionFaultKind::kSilence || kind == MotionFaultKind::kCarried;
}

Duration lasts_for(const MotionFault& fault) {
  if (fault.kind == MotionFaultKind::kYawJump) return kYawJumpTime;
  if (fault.kind == MotionFaultKind::kYawTurn) return kYawTurnTime;
  const bool lasts = hides_samples(fault.kind) || fault.kind == MotionFaultKind::kSlip;
  return lasts ? from_seconds(fault.amount) : Duration::zero();
}

}  // namespace

/// What the fault does to the first sample that is received after it began.
void FaultySampleSource::begin(const MotionFault& fault, RangeSample& sample) {
  switch (fault.kind) {
    case MotionFaultKind::kSilence:
      sample.starts_segment = sample.odometry_ran_on = true;
      break;
    case MotionFaultKind::kRestart:
    case MotionFaultKind::kReset:
    case MotionFaultKind::kCarried:
      if (fault.kind == MotionFaultKind::kRestart) added_ += from_seconds(fault.amount);
      T_fault_odom_ = sample.T_odom_body.inverse();
      sample.starts_segment = true;
      sample.odometry_ran_on = false;
      break;
    case MotionFaultKind::kTeleport:
      added_ -= from_seconds(fault.amount);
      T_fault_odom_ = T_fault_odom_ * T_odom_last_ * sample.T_odom_body.inverse();
      break;
    case MotionFaultKind::kSlip:
      break;
    case MotionFaultKind::kYawJump:
    case MotionFaultKind::kYawTurn:
      turn_to(radians(fault.amount), sample.T_odom_body);
      turned_rad_ = 0.0;
      break;
  }
}

/// So far altogether, by the fault that turns the estimate now.
void FaultySampleSource::turn_to(double turned_rad, const Pose2& T_odom_body) {
  const Pose2 turn(0.0, 0.0, turned_rad - std::exchange(turned_rad_, turned_rad));
  T_fault_odom_ = T_fault_odom_ * T_odom_body * turn * T_odom_body.inverse();
}

/// Into the estimate as the faults have left it.
void FaultySampleSource::place(RangeSample& sample) {
  const Pose2 T_odom_body = sample.T_odom_body;
  if (lasting_ && lasting_->kind == MotionFaultKind::kSlip) {
    const Pose2 stays(T_odom_last_.x_m(), T_odom_last_.y_m(), T_odom_body.yaw_rad());
    T_fault_odom_ = T_fault_odom_ * stays * T_odom_body.inverse();
  } else if (lasting_ && turns(lasting_->kind)) {
    const Duration since = sample.measured_at - *first_at_ - lasting_->after;
    turn_to(radians(lasting_->amount) * to_seconds(since) / to_seconds(lasts_for(*lasting_)), T_odom_body);
  }
  sample.T_odom_body = T_fault_odom_ * T_odom_body;
  sample.measured_at += added_;
  sample.stamp += added_;
  T_odom_last_ = T_odom_body;
}

std::vector<StampedPose> FaultySampleSource::ground_truth() const {
  const std::vector<StampedPose> flown = inner().ground_truth();
  std::vector<StampedPose> truth;
  for (const Delivered& sample : delivered_)
    if (sample.number < flown.size())
      truth.push_back({flown[sample.number].stamp + sample.added, flown[sample.number].pose});
  return truth;
}

void FaultySampleSource::update_report() {
  report_ = ForwardingSource::report();
  InputCounters& counters = report_.counters;
  counters.samples = delivered_.size();
  counters.segments = segments_;
  counters.gaps += gaps_;
  counters.missing_packets += missing_;
}

void FaultySampleSource::end() {
  ForwardingSource::end();
  for (std::size_t i = next_fault_; i < faults_.size(); ++i)
    add_note("the fault after " + shortest_text(to_seconds(faults_[i].after)) +
             " s never began: the flight ended before");
  update_report();
}

Result<ReceivedSample> FaultySampleSource::next() {
  Result<ReceivedSample> received = next_of_those_left();
  update_report();
  return received;
}

Result<ReceivedSample> FaultySampleSource::next_of_those_left() {
  for (;;) {
    Result<ReceivedSample> received = inner().next();
    if (!received) return received;
    RangeSample& sample = received->sample;
    const std::size_t number = received_++;
    if (!first_at_) first_at_ = sample.measured_at;
    if (!survives_faults(sample, sample.measured_at - *first_at_)) continue;
    place(sample);
    sample.sequence = static_cast<std::uint32_t>(delivered_.size());
    segments_ += sample.starts_segment ? 1U : 0U;
    delivered_.push_back({number, added_});
    return received;
  }
}

/// The first sample behind a fault shows what it did.
bool FaultySampleSource::survives_faults(RangeSample& sample, Duration at) {
  const bool begins = !lasting_ && next_fault_ < faults_.size() && at >= faults_[next_fault_].after;
  if (begins) lasting_ = faults_[next_fault_++];
  if (!lasting_) return true;
  if (at < lasting_->after + lasts_for(*lasting_)) {
    gaps_ += begins && is_gap(lasting_->kind) ? 1U : 0U;
    missing_ += is_gap(lasting_->kind) ? 1U : 0U;
    return !hides_samples(lasting_->kind);
  }
  begin(*lasting_, sample);
  lasting_.reset();
  return true;
}

}  // namespace swiftlet
