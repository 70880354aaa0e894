// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// What the daemon's parts hold before the first sample has come: one line each with a name, the object's own
// bytes and those that its constructor takes from the heap, apart by tabs. For tools/measure-size.
#include <malloc.h>

#include <cstddef>
#include <cstdio>
#include <memory>

#include "core/backend/backend.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_builder.hpp"
#include "core/sensing/sensor_model.hpp"
#include "daemon/workers/pipeline_queues.hpp"
#include "daemon/workers/stage_times.hpp"

namespace swiftlet {
namespace {

std::size_t heap_in_use() {
  const struct mallinfo2 now = ::mallinfo2();
  return now.uordblks + now.hblkhd;
}

void say(const char* name, std::size_t own, std::size_t heap) {
  std::printf("%s\t%zu\t%zu\n", name, own, heap);
}

template <typename Part, typename... Arguments>
void say_part(const char* name, const Arguments&... arguments) {
  const std::size_t before = heap_in_use();
  const Part part(arguments...);
  say(name, sizeof(Part), heap_in_use() - before);
}

/// Those are fixed in their own bytes alone.
template <typename Queue>
void say_queue(const char* name) {
  say(name, sizeof(Queue), 0);
}

void say_all() {
  const SensorModel sensor = SensorModel::crazyflie();
  const BeamLayout beams = BeamLayout::multiranger();
  say_part<Frontend>("frontend", FrontendConfig{}, sensor, beams);
  say_queue<PipelineQueues>("queues between the threads");
  say_queue<SampleQueue>("... samples");
  say_queue<StepQueue>("... steps");
  say_queue<PoseQueue>("... poses");
  say_queue<TileQueue>("... tiles");
  say_queue<WallQueue>("... walls");
  say_queue<ClosureQueue>("... closures");
  say_queue<EventQueue>("... events");
  say_queue<RecordingQueue>("recording queue, where recorded");
  say_queue<StageTimes>("histograms of the stages");
  say_queue<PoseLatency>("histogram of frame to pose");
  say_part<Backend>("backend, empty", BackendConfig{}, sensor, beams);
  say_part<MapBuilder>("map, empty", MapConfig{}, sensor);
}

}  // namespace
}  // namespace swiftlet

int main() {
  swiftlet::say_all();
  return 0;
}
