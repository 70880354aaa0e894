// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/live_evaluation.hpp"

#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>

#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "tools/evaluation/common_time.hpp"
#include "tools/evaluation/live_observer.hpp"
#include "tools/evaluation/tum_file.hpp"
#include "tools/prepared_run.hpp"

namespace swiftlet {
namespace {

/// An input that ends behind the first sample at or after a stamp.
class EarlyEnd final : public SampleSource {
 public:
  EarlyEnd(std::unique_ptr<SampleSource> whole, HostTime last) : whole_(std::move(whole)), last_(last) {}

  [[nodiscard]] Result<ReceivedSample> next() override {
    if (has_ended_) return Error{ErrorCode::kEndOfRecording, "ends early"};
    Result<ReceivedSample> received = whole_->next();
    has_ended_ = received && received->sample.stamp >= last_;
    return received;
  }
  [[nodiscard]] const BeamLayout& beams() const override { return whole_->beams(); }
  [[nodiscard]] const SensorModel& sensor() const override { return whole_->sensor(); }
  [[nodiscard]] const InputReport& report() const override { return whole_->report(); }
  void end() override { whole_->end(); }

 private:
  std::unique_ptr<SampleSource> whole_;
  HostTime last_;
  bool has_ended_ = false;
};

Status run_to_end(Pipeline& pipeline, LiveObserver* observer) {
  Result<bool> more = pipeline.step();
  while (more && *more) {
    if (observer != nullptr) observer->look();
    more = pipeline.step();
  }
  if (!more) return more.error();
  return {};
}

/// Of the truth's file; nothing without one.
Result<std::optional<StampedPath>> measured_path(const std::string& truth_file) {
  if (truth_file.empty()) return std::optional<StampedPath>();
  Result<std::vector<StampedPose>> read = read_tum_file(truth_file);
  if (!read) return read.error();
  return std::optional(StampedPath(std::move(read).value()));
}

/// Whether any published pose has a true one.
Status check_common_stamps(const std::string& truth_file, const StampedPath& truth,
                           std::span<const DoubtedPose> published) {
  std::vector<HostTime> stamps;
  for (const DoubtedPose& pose : published) {
    if (truth.nearest(pose.stamp) != nullptr) return {};
    stamps.push_back(pose.stamp);
  }
  return nothing_in_common(truth_file, "has no pose within 2 ms of any of the trajectory's stamps",
                           span_of(truth), span_of(stamps));
}

/// The measured one or, without it, that of the simulation or the run's own final path.
Result<StampedPath> true_path(const std::optional<StampedPath>& measured, const SampleSource& source,
                              const Backend& finished, const PrunedScans& pruned) {
  if (measured) return *measured;
  std::vector<StampedPose> truth = source.ground_truth();
  if (!truth.empty()) return StampedPath(std::move(truth));
  const Status visited = pruned.for_each_scan(finished, [&](const TrajectoryPoint& at) {
    truth.push_back({at.stamp, at.T_map_body});
  });
  if (!visited) return visited.error();
  return StampedPath(std::move(truth));
}

/// The error of the newest pose when the run ends at the stamp.
Result<std::optional<double>> error_of_batch(const MapCommand& map, const PreparedRun& run, HostTime stamp,
                                             const StampedPath& truth) {
  Result<std::unique_ptr<SampleSource>> whole = open_input(map, run);
  if (!whole) return whole.error();
  EarlyEnd source(std::move(whole).value(), stamp);
  Pipeline pipeline(run.config, source);
  if (Status ended = run_to_end(pipeline, nullptr); !ended) return ended.error();
  const KnownPlaceError error = newest_pose_error(pipeline.backend(), truth);
  return error.moments > 0 ? std::optional(error.rms_m) : std::nullopt;
}

/// Sums over moments at known places.
class ErrorSum {
 public:
  void add(double error_m) {
    ++count_;
    sum_m2_ += error_m * error_m;
    off_ += error_m > KnownPlaceTuning{}.off_m ? 1U : 0U;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double rms_m() const { return std::sqrt(sum_m2_ / static_cast<double>(count_)); }
  [[nodiscard]] double share_off() const { return static_cast<double>(off_) / static_cast<double>(count_); }

 private:
  std::size_t count_ = 0;
  std::size_t off_ = 0;
  double sum_m2_ = 0.0;
};

Result<BatchError> batch_error(const MapCommand& map, const PreparedRun& run, double every_s,
                               std::span<const StampedError> live, const StampedPath& truth) {
  ErrorSum batch;
  ErrorSum published;
  std::optional<HostTime> last;
  for (const StampedError& at : live) {
    if (last && to_seconds(at.stamp - *last) < every_s) continue;
    last = at.stamp;
    const Result<std::optional<double>> error_m = error_of_batch(map, run, at.stamp, truth);
    if (!error_m) return error_m.error();
    if (!*error_m) continue;
    batch.add(**error_m);
    published.add(at.error_m);
  }
  if (batch.count() == 0) return BatchError{};
  return BatchError{batch.count(), batch.rms_m(), batch.share_off(), published.rms_m(),
                    published.share_off()};
}

LiveEvaluation evaluation_of(const std::string& input, const LiveObserver& observer, const StampedPath& truth,
                             InputReport report) {
  LiveEvaluation evaluation{input, observer.error(truth), {}, {}};
  evaluation.consistency = {consistency(observer.doubted_poses(), truth),
                            count_alarms(observer.doubted_poses(), evaluation.live.errors)};
  evaluation.poses.assign(observer.doubted_poses().begin(), observer.doubted_poses().end());
  evaluation.report = std::move(report);
  return evaluation;
}

}  // namespace

Result<LiveEvaluation> evaluate_live(const LiveEvalCommand& command) {
  const Result<std::optional<StampedPath>> measured = measured_path(command.truth_file);
  if (!measured) return measured.error();
  MapCommand map;
  map.input = command.input;
  map.config_file = command.config_file;
  map.calibrate = command.calibrate;
  const Result<PreparedRun> prepared = prepare_run(map);
  if (!prepared) return prepared.error();
  Result<PrunedScans> pruned = PrunedScans::open(std::filesystem::temp_directory_path());
  if (!pruned) return pruned.error();
  Pipeline pipeline(prepared->config, *prepared->source);
  pipeline.keep_pruned(*pruned);
  LiveObserver observer(pipeline.backend());
  const Status ended = run_to_end(pipeline, &observer);
  InputReport report = report_of(*prepared, ended);
  if (Status usable = check_usable(map, report, pipeline.backend()); !usable) return usable.error();
  if (*measured)
    if (Status common = check_common_stamps(command.truth_file, **measured, observer.doubted_poses());
        !common)
      return common.error();
  const Result<StampedPath> truth = true_path(*measured, *prepared->source, pipeline.backend(), *pruned);
  if (!truth) return truth.error();
  LiveEvaluation evaluation = evaluation_of(command.input, observer, *truth, std::move(report));
  if (!command.batch_s) return evaluation;
  Result<BatchError> batch = batch_error(map, *prepared, *command.batch_s, evaluation.live.errors, *truth);
  if (!batch) return batch.error();
  evaluation.batch = *batch;
  return evaluation;
}

}  // namespace swiftlet
