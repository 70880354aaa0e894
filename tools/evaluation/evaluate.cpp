// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/evaluate.hpp"

#include <memory>
#include <utility>

#include "core/base/check.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "tools/evaluation/common_time.hpp"
#include "tools/evaluation/relations_file.hpp"
#include "tools/evaluation/tum_file.hpp"

namespace swiftlet {
namespace {

Result<ReferenceResult> against_relations(const StampedPath& trajectory, const std::string& file) {
  const Result<std::vector<Relation>> relations = read_relations_file(file);
  if (!relations) return relations.error();
  RelationError error = relation_error(*relations, trajectory);
  if (error.all.count > 0) return ReferenceResult{file, std::move(error)};
  std::vector<HostTime> stamps;
  for (const Relation& relation : *relations) stamps.insert(stamps.end(), {relation.first, relation.second});
  return nothing_in_common(file,
                           "of none of its relations does the trajectory have both stamps (within 2 ms)",
                           span_of(stamps), span_of(trajectory));
}

Result<ReferenceResult> against_truth(const StampedPath& trajectory, const std::string& file) {
  Result<std::vector<StampedPose>> poses = read_tum_file(file);
  if (!poses) return poses.error();
  const StampedPath truth(std::move(poses).value());
  PathError error = path_error(trajectory, truth);
  if (error.position.pairs > 0) return ReferenceResult{file, std::move(error)};
  return nothing_in_common(file, "has no position near any of the trajectory's stamps", span_of(truth),
                           span_of(trajectory));
}

Result<ReferenceResult> against_flight(const StampedPath& trajectory, const std::string& file) {
  const Result<std::unique_ptr<SampleSource>> source = open_sample_source(file, {});
  if (!source) return source.error();
  std::vector<RangeSample> samples;
  Result<ReceivedSample> received = (*source)->next();
  for (; received || received.error().code == ErrorCode::kTimeout; received = (*source)->next())
    if (received) samples.push_back(received->sample);
  if (received.error().code != ErrorCode::kEndOfRecording) return received.error();
  FlightSharpness sharpness = flight_sharpness(samples, trajectory, (*source)->beams());
  if (sharpness.drawn > 0)
    return ReferenceResult{file, FlightResult{std::move(sharpness), (*source)->report()}};
  if (samples.empty()) return Error{ErrorCode::kInvalidInput, file + ": holds no sample"};
  return nothing_in_common(file, "has no sample within the trajectory's time", span_of(sharpness.outside),
                           span_of(trajectory));
}

}  // namespace

Result<ReferenceResult> evaluate_against(const StampedPath& trajectory, const std::string& file,
                                         ReferenceKind kind) {
  SWIFTLET_CHECK(!trajectory.poses().empty(), "a trajectory to be judged has poses");
  switch (kind) {
    case ReferenceKind::kRelations:
      return against_relations(trajectory, file);
    case ReferenceKind::kTruth:
      return against_truth(trajectory, file);
    case ReferenceKind::kFlight:
      break;
  }
  return against_flight(trajectory, file);
}

}  // namespace swiftlet
