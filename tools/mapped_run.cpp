// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/mapped_run.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "daemon/outputs/peak_memory.hpp"
#include "daemon/workers/pipeline.hpp"
#include "daemon/workers/pruned_scans.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "tools/evaluation/confidence_history.hpp"
#include "tools/evaluation/live_observer.hpp"
#include "tools/progress_bar.hpp"

namespace swiftlet {
namespace {

bool is_simulation(const std::string& input) {
  const Result<InputUri> uri = parse_input_uri(input);
  return uri && uri->is(InputNature::kSimulation);
}

}  // namespace

struct MappedRun::State {
  State(const MapCommand& command, PreparedRun of, PrunedScans scans, bool keeps_confidence)
      : prepared(std::move(of)),
        pruned(std::move(scans)),
        input_uri(command.input),
        pipeline(prepared.config, *prepared.source) {
    pipeline.keep_pruned(pruned);
    if (is_simulation(command.input)) {
      observer.emplace(pipeline.backend());
    } else if (keeps_confidence) {
      confidence.emplace(pipeline.backend());
    }
  }

  void look() {
    if (observer) observer->look();
    if (confidence) confidence->look();
  }
  Status run(const MappingWatch& watch);
  void conclude();

  PreparedRun prepared;
  PrunedScans pruned;
  std::string input_uri;
  Pipeline pipeline;
  std::optional<LiveObserver> observer;
  std::optional<ConfidenceHistory> confidence;  // where there is no observer, which has its own
  InputReport report;
  std::vector<StampedPose> truth;
  std::optional<KnownPlaceError> known_places;
  std::optional<RunConsistency> consistency_of_run;
  double peak_memory_mb = 0.0;
};

Status MappedRun::State::run(const MappingWatch& watch) {
  Result<bool> more = true;
  while (more && *more) {
    if (watch.stop.stop_requested()) return stopped_error(input_uri);
    more = pipeline.step();
    if (!more || !*more) break;
    look();
    if (watch.after_sample) watch.after_sample(prepared.source->progress());
  }
  report = report_of(prepared, more ? Status() : more.error());
  return {};
}

/// Before the outputs take their room.
void MappedRun::State::conclude() {
  peak_memory_mb = swiftlet::peak_memory_mb();
  truth = prepared.source->ground_truth();
  if (!observer) return;
  const StampedPath T_world_body(truth);
  known_places = observer->error(T_world_body);
  const std::span<const DoubtedPose> poses = observer->doubted_poses();
  consistency_of_run =
      RunConsistency{consistency(poses, T_world_body), count_alarms(poses, known_places->errors)};
}

MappedRun::MappedRun(std::unique_ptr<State> state) : state_(std::move(state)) {}
MappedRun::~MappedRun() = default;

Result<std::unique_ptr<MappedRun>> MappedRun::make(const MapCommand& command, PreparedRun prepared,
                                                   const std::filesystem::path& scratch,
                                                   const MappingWatch& watch) {
  Result<PrunedScans> pruned = PrunedScans::open(scratch);
  if (!pruned) return pruned.error();
  auto state = std::make_unique<State>(command, std::move(prepared), std::move(pruned).value(),
                                       watch.keeps_confidence);
  if (Status ran = state->run(watch); !ran) return ran.error();
  if (Status usable = check_usable(command, state->report, state->pipeline.backend()); !usable)
    return usable.error();
  state->conclude();
  return std::unique_ptr<MappedRun>(new MappedRun(std::move(state)));
}

RunView MappedRun::view() const {
  const State& s = *state_;
  return {.backend = s.pipeline.backend(),
          .map = s.pipeline.map(),
          .input = s.report,
          .frontend = s.pipeline.frontend().counters(),
          .timing = s.pipeline.timing(),
          .truth = s.truth,
          .input_uri = s.input_uri,
          .sensor = s.prepared.config.sensor.applied_to(s.prepared.source->sensor()),
          .calibration = s.prepared.calibration,
          .mended = s.prepared.source->mended(),
          .pruned = &s.pruned,
          .known_places = s.known_places,
          .consistency = s.consistency_of_run,
          .peak_memory_mb = s.peak_memory_mb};
}

const Backend& MappedRun::backend() const { return std::as_const(state_->pipeline).backend(); }
const InputReport& MappedRun::report() const { return state_->report; }
std::span<const DoubtedPose> MappedRun::poses_with_doubt() const {
  if (state_->observer) return state_->observer->doubted_poses();
  if (state_->confidence) return state_->confidence->poses();
  return {};
}

Result<std::unique_ptr<MappedRun>> map_with_progress_bar(const MapCommand& command, PreparedRun prepared,
                                                         const std::filesystem::path& scratch,
                                                         const std::stop_token& stop) {
  ProgressBar bar(stderr, ProgressBar::Clock::now());
  MappingWatch watch;
  watch.stop = stop;
  watch.after_sample = [&bar](std::optional<double> progress) {
    bar.update(progress, ProgressBar::Clock::now());
  };
  return MappedRun::make(command, std::move(prepared), scratch, watch);
}

}  // namespace swiftlet
