// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/run_narrator.hpp"

#include <spdlog/fmt/fmt.h>

#include <string>
#include <string_view>

#include "firmware_link/link/link_condition.hpp"
#include "swiftlet/link_status_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/status_t.hpp"

namespace swiftlet {
namespace {

// One cell, at rest under load: below that a Crazyflie soon sinks.
constexpr double kBatteryLowV = 3.2;
constexpr double kBatteryRecoveredV = 3.5;
// A poor link loses something each second: that must not hide what else happens.
constexpr std::int64_t kLossesApartUs = 15'000'000;

std::string link_text(std::int8_t condition) {
  if (condition < 0 || condition > static_cast<std::int8_t>(LinkCondition::kDeviceUnsuited))
    return "link: unknown condition";
  return "link: " + std::string(describe(static_cast<LinkCondition>(condition)));
}

std::string counted(std::int64_t count, std::string_view things) {
  return fmt::format("{} {}{}", count, things, count == 1 ? "" : "s");
}

}  // namespace

void RunNarrator::begin_with_run() {
  if (generation_ == history_.generation()) return;
  generation_ = history_.generation();
  status_.reset();
  pose_.reset();
  battery_is_low_ = false;
  missing_ = {};
  late_ = {};
}

void RunNarrator::see_pose(const TrailPose& pose) {
  begin_with_run();
  if (!pose_) history_.add_event(pose.utime_us, EventLevel::kNote, "first pose");
  if (pose_ && pose.segment != pose_->segment)
    history_.add_event(pose.utime_us, EventLevel::kWarning,
                       fmt::format("segment {}: a silence, a restart or a reset", pose.segment));
  const std::int8_t before = pose_ ? pose_->tracking : pose_t::TRACKING_GOOD;
  if (pose.tracking != before) tell_tracking(pose);
  pose_ = pose;
}

void RunNarrator::tell_tracking(const TrailPose& pose) {
  const auto tell = [&](EventLevel level, const char* text) {
    history_.add_event(pose.utime_us, level, text);
  };
  if (pose.tracking == pose_t::TRACKING_GOOD)
    tell(EventLevel::kGood, "tracking good: what is seen agrees with the map");
  if (pose.tracking == pose_t::TRACKING_UNCERTAIN)
    tell(EventLevel::kWarning, "tracking uncertain: what is seen contradicts the map");
  if (pose.tracking == pose_t::TRACKING_LOST) tell(EventLevel::kBad, "lost: motion was not watched");
  if (pose.tracking == pose_t::TRACKING_RELOCALIZING)
    tell(EventLevel::kWarning, "relocalizing: places in the map are weighed");
}

void RunNarrator::see_status(const RunStatus& status) {
  begin_with_run();
  tell_state(status);
  tell_link(status);
  tell_battery(status);
  tell_losses(status);
  status_ = status;
}

void RunNarrator::tell_state(const RunStatus& status) {
  const std::int8_t before = status_ ? status_->state : status_t::STATE_RUNNING;
  if (status.state == before) return;
  if (status.state == status_t::STATE_FINISHING)
    history_.add_event(status.utime_us, EventLevel::kNote, "input ended: the final pass runs");
  if (status.state == status_t::STATE_FINISHED)
    history_.add_event(status.utime_us, EventLevel::kGood, "finished: the map is final");
}

void RunNarrator::tell_link(const RunStatus& status) {
  const std::int8_t before = status_ ? status_->link_condition : link_status_t::CONDITION_NONE;
  if (status.link_condition != before) {
    const bool is_good = status.link_condition == link_status_t::CONDITION_CONNECTED;
    history_.add_event(status.utime_us, is_good ? EventLevel::kGood : EventLevel::kBad,
                       link_text(status.link_condition));
  }
  const int was_flying = status_ ? status_->flying : -1;
  if (status.flying == 1 && was_flying != 1) history_.add_event(status.utime_us, EventLevel::kNote, "flying");
  if (status.flying == 0 && was_flying == 1) history_.add_event(status.utime_us, EventLevel::kNote, "landed");
}

void RunNarrator::tell_battery(const RunStatus& status) {
  if (status.battery_v <= 0.0) return;
  if (!battery_is_low_ && status.battery_v < kBatteryLowV) {
    battery_is_low_ = true;
    history_.add_event(status.utime_us, EventLevel::kBad,
                       fmt::format("battery low: {:.2f} V", status.battery_v));
  }
  if (status.battery_v > kBatteryRecoveredV) battery_is_low_ = false;
}

void RunNarrator::tell_losses(const RunStatus& status) {
  tell_more(missing_, status.missing_packets, status.utime_us, "packet", "with ranges missing");
  tell_more(late_, status.missed_deadlines, status.utime_us, "pose", "later than allowed");
}

void RunNarrator::tell_more(Losses& told, std::int64_t count, std::int64_t utime_us, std::string_view thing,
                            std::string_view fate) {
  if (!status_) told.count = count;  // what was before is not news
  if (count <= told.count || (told.at_us && utime_us - *told.at_us < kLossesApartUs)) return;
  history_.add_event(utime_us, EventLevel::kWarning,
                     fmt::format("{} {}, {} in all", counted(count - told.count, thing), fate, count));
  told = {.count = count, .at_us = utime_us};
}

void RunNarrator::see_event(const std::string& text, std::int64_t utime_us) {
  begin_with_run();
  history_.add_event(utime_us, EventLevel::kBad, text);
}

void RunNarrator::see_closure(const SeenClosure& closure, bool is_dropped, std::int64_t utime_us) {
  begin_with_run();
  if (is_dropped)
    history_.add_event(utime_us, EventLevel::kWarning,
                       fmt::format("loop {} dropped: what else was seen contradicts it", closure.index));
  else
    history_.add_event(utime_us, EventLevel::kGood,
                       fmt::format("loop {} closed: keyframe {} meets {}, score {:.2f}", closure.index,
                                   closure.to_keyframe, closure.from_keyframe, closure.score));
}

}  // namespace swiftlet
