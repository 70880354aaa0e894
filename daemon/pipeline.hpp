// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/configuration.hpp"
#include "daemon/stage_times.hpp"
#include "firmware_link/sample_source.hpp"

namespace swiftlet {

/// The workers (radio, frontend, backend) and the queues between them, wired for one input. In lockstep one
/// thread calls step(); the daemon gives each worker a thread of its own. The same steps either way.
class Pipeline {
 public:
  /// `source` must outlive the pipeline. Precondition: config.validate() is empty.
  Pipeline(const Configuration& config, SampleSource& source);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// Lockstep: takes the next sample through all stages in the calling thread. False when the input has ended
  /// and the backend's final pass is done. Errors: whatever ended the input before its time (outputs are
  /// still valid).
  [[nodiscard]] Result<bool> step();

  // Not while threads run.
  [[nodiscard]] const Backend& backend() const;
  [[nodiscard]] const Frontend& frontend() const;
  [[nodiscard]] const MapBuilder& map() const;
  [[nodiscard]] std::vector<StageSummary> stage_times() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet
