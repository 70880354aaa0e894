// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/backend/backend.hpp"
#include "core/base/latest_value.hpp"
#include "core/base/spsc_queue.hpp"
#include "core/frontend/frontend.hpp"
#include "core/mapping/map_tile.hpp"
#include "core/sensing/keyframe.hpp"
#include "daemon/workers/command.hpp"
#include "daemon/workers/pipeline_messages.hpp"
#include "daemon/workers/run_timing.hpp"
#include "daemon/workers/stage_queue.hpp"
#include "firmware_link/link/link.hpp"
#include "firmware_link/sample/received_sample.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

// Every carrier between two workers is declared here, with what happens when it is full.

/// radio -> frontend: 25 s at 10 Hz. Full: a recording waits; from a live link the newest sample is refused
/// and counted. The only place where anything on the way into the map can be lost.
using SampleQueue = StageQueue<ReceivedSample, 256>;
/// frontend -> backend: 25 s at 10 Hz, many times its longest step. Full: the frontend waits, so no keyframe
/// is ever missing from the graph; the samples wait (or are refused) in the queue before it.
using StepQueue = StageQueue<FrontendStep, 256>;
/// commands -> backend, with `--commands`. Full: the newest is refused, which the log says.
using CommandQueue = SpscQueue<Command, 16>;
/// backend -> frontend: newest wins.
using CorrectionValue = LatestValue<MapCorrection>;

/// backend -> frontend: newest wins. For poses that are published only.
using ConfidenceValue = LatestValue<PoseConfidence>;

/// frontend -> publisher: 25 s at 10 Hz. Full: the newest pose is refused and counted; the map misses
/// nothing.
using PoseQueue = StageQueue<PoseUpdate, 256>;
/// backend -> publisher. Full: what did not fit stays with the backend's worker, which offers its newest
/// state again later. Closed when everything has been handed over, after the final pass.
using TileQueue = StageQueue<MapTile, 64>;
/// backend -> publisher. Full: as for tiles.
using WallQueue = SpscQueue<WallInMap, 1024>;
/// backend -> publisher. Full: as for tiles.
using ClosureQueue = SpscQueue<ClosureUpdate, 256>;

/// radio -> publisher, which puts them into words. Full: the newest is refused and counted.
using EventQueue = SpscQueue<VehicleEvent, 64>;

/// The radio worker's end of what goes to the publisher.
struct InputOutlet {
  LatestValue<InputStatus>& status;
  EventQueue::Producer events;
};
/// The frontend worker's end of what goes to the publisher.
struct FrontendOutlet {
  PoseQueue::Producer poses;
  LatestValue<FrontendCounters>& counters;
  ConfidenceValue& confidence;  ///< of the poses, by the backend
};
/// The backend worker's end.
struct BackendOutlet {
  TileQueue::Producer tiles;
  WallQueue::Producer walls;
  ClosureQueue::Producer closures;
  LatestValue<BackendCounters>& counters;
  LatestValue<TrackingFigures>& tracking;
  ConfidenceValue& confidence;  ///< for the frontend's poses
};
/// The publisher's end.
struct PublisherInlet {
  PoseQueue::Consumer poses;
  TileQueue::Consumer tiles;
  WallQueue::Consumer walls;
  ClosureQueue::Consumer closures;
  EventQueue::Consumer events;
  LatestValue<InputStatus>& input;
  LatestValue<FrontendCounters>& frontend;
  LatestValue<BackendCounters>& backend;
  LatestValue<TrackingFigures>& tracking;
};

/// From the workers to the publisher.
struct PublisherQueues {
  PoseQueue poses;
  TileQueue tiles;
  WallQueue walls;
  ClosureQueue closures;
  EventQueue events;
  LatestValue<InputStatus> input;          ///< radio -> publisher: newest wins
  LatestValue<FrontendCounters> frontend;  ///< frontend -> publisher: newest wins
  LatestValue<BackendCounters> backend;    ///< backend -> publisher: newest wins
  LatestValue<TrackingFigures> tracking;   ///< backend -> publisher: newest wins
  ConfidenceValue confidence;              ///< backend -> frontend: newest wins

  InputOutlet input_outlet() { return {input, events.producer()}; }
  FrontendOutlet frontend_outlet() { return {poses.producer(), frontend, confidence}; }
  BackendOutlet backend_outlet() {
    return {tiles.producer(), walls.producer(), closures.producer(), backend, tracking, confidence};
  }
  PublisherInlet inlet() {
    return {
        poses.consumer(), tiles.consumer(), walls.consumer(), closures.consumer(), events.consumer(), input,
        frontend,         backend,          tracking};
  }
};

/// radio -> recorder: 8 s of the busiest link (1000 packets a second), many minutes of a usual one. Full: the
/// newest frame is refused and counted, and the recorder reports it; a simulation waits instead. One for each
/// recorder, not among the pipeline's own: the recording begins before the pipeline and ends after it.
using RecordingQueue = StageQueue<LinkFrame, 8192>;

/// Several megabytes: belongs on the heap.
struct PipelineQueues {
  SampleQueue samples;
  StepQueue steps;
  CommandQueue commands;
  CorrectionValue correction;
  PublisherQueues to_publisher;

  /// Any thread.
  [[nodiscard]] std::array<QueueStatistics, 7> statistics() const {
    const auto of = [](std::string_view name, const auto& queue) {
      return QueueStatistics{name, queue.capacity(), queue.high_water(), queue.rejected_count()};
    };
    return {of("samples", samples),           of("steps", steps),
            of("poses", to_publisher.poses),  of("tiles", to_publisher.tiles),
            of("walls", to_publisher.walls),  of("closures", to_publisher.closures),
            of("events", to_publisher.events)};
  }
};

}  // namespace swiftlet
