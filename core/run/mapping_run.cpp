// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/mapping_run.hpp"

#include "core/frontend/frontend.hpp"

namespace swiftlet {

Result<MappingRun> map_samples(std::span<const RangeSample> samples, const MappingSettings& settings,
                               const BeamLayout& beams, const GoOn& go_on) {
  Frontend frontend(settings.frontend, settings.sensor, beams);
  Backend backend(settings.backend, settings.sensor, beams);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const FrontendStep& step = frontend.process(samples[i]);
    static_cast<void>(backend.add(step));
    const double done = static_cast<double>(i) / static_cast<double>(samples.size());
    if (step.has_keyframe && !go_on(done)) return Error{ErrorCode::kTimeout, "stopped"};
  }
  static_cast<void>(backend.finish());
  MappingRun run{{}, backend.counters()};
  for (const auto& [id, scan] : backend.scans().all()) run.T_map_body.push_back(backend.T_map_body(id));
  return run;
}

}  // namespace swiftlet
