// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/eval_command.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "daemon/outputs/file_writer.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "tools/command_end.hpp"
#include "tools/evaluation/eval_report.hpp"
#include "tools/evaluation/evaluate.hpp"
#include "tools/evaluation/live_evaluation.hpp"
#include "tools/evaluation/reference_kind.hpp"
#include "tools/evaluation/tum_file.hpp"

namespace swiftlet {
namespace {

struct NamedReference {
  std::string file;
  ReferenceKind kind;
};

Result<std::vector<NamedReference>> references_of(const EvalCommand& command) {
  std::vector<NamedReference> references;
  for (const std::string& file : command.references) {
    const Result<ReferenceKind> kind = recognise_reference(file);
    if (!kind) return kind.error();
    references.push_back({file, *kind});
  }
  for (const std::string& file : command.relations) references.push_back({file, ReferenceKind::kRelations});
  for (const std::string& file : command.truths) references.push_back({file, ReferenceKind::kTruth});
  if (references.empty())
    return Error{ErrorCode::kInvalidInput,
                 "eval: no reference given; name relations, a true trajectory or the flight's capture"};
  return references;
}

Result<Evaluation> evaluate(const EvalCommand& command) {
  const Result<std::vector<NamedReference>> references = references_of(command);
  if (!references) return references.error();
  Result<std::vector<StampedPose>> poses = read_tum_file(command.trajectory);
  if (!poses) return poses.error();
  const StampedPath trajectory(std::move(poses).value());
  Evaluation evaluation{command.trajectory,
                        trajectory.poses().size(),
                        trajectory.poses().front().stamp,
                        trajectory.poses().back().stamp,
                        {}};
  for (const NamedReference& reference : *references) {
    Result<ReferenceResult> result = evaluate_against(trajectory, reference.file, reference.kind);
    if (!result) return result.error();
    evaluation.references.push_back(std::move(result).value());
  }
  return evaluation;
}

bool is_json_alone(const EvalCommand& command) { return command.json_file == "-"; }

/// Asked before the work.
Status check_json_file(const EvalCommand& command) {
  if (command.json_file.empty() || is_json_alone(command)) return {};
  std::vector<std::filesystem::path> inputs{command.config_file};
  inputs.emplace_back(command.live ? file_of_input(command.trajectory) : command.trajectory);
  for (const std::vector<std::string>* files : {&command.references, &command.relations, &command.truths})
    inputs.insert(inputs.end(), files->begin(), files->end());
  return check_output_file(command.json_file, inputs);
}

/// The table comes first: it is there whatever becomes of the file.
Status write_figures(const EvalCommand& command, const std::string& text, const std::string& json) {
  std::fputs((is_json_alone(command) ? json : text).c_str(), stdout);
  if (command.json_file.empty() || is_json_alone(command)) return {};
  return write_file(command.json_file, json);
}

Status evaluate_poses_as_published(const EvalCommand& command) {
  std::vector<std::string> truths = command.truths;
  truths.insert(truths.end(), command.references.begin(), command.references.end());
  if (truths.size() > 1 || !command.relations.empty())
    return Error{ErrorCode::kInvalidInput, "eval --live: takes one reference at most, a true trajectory"};
  const Result<LiveEvaluation> evaluation =
      evaluate_live({command.trajectory, truths.empty() ? "" : truths[0], command.config_file,
                     command.batch_s, command.calibrate});
  if (!evaluation) return evaluation.error();
  const Status written =
      write_figures(command, live_evaluation_text(*evaluation), live_evaluation_json(*evaluation));
  return conclude(written, evaluation->report);
}

/// Notes and problems of all captures.
InputReport captures_of(const Evaluation& evaluation) {
  InputReport all;
  for (const ReferenceResult& reference : evaluation.references) {
    const auto* flight = std::get_if<FlightResult>(&reference.figures);
    if (flight == nullptr) continue;
    const InputReport& input = flight->input;
    all.notes.insert(all.notes.end(), input.notes.begin(), input.notes.end());
    all.problems.insert(all.problems.end(), input.problems.begin(), input.problems.end());
  }
  return all;
}

Status evaluate_trajectory(const EvalCommand& command) {
  const Result<Evaluation> evaluation = evaluate(command);
  if (!evaluation) return evaluation.error();
  const Status written = write_figures(command, evaluation_text(*evaluation), evaluation_json(*evaluation));
  return conclude(written, captures_of(*evaluation));
}

}  // namespace

Status run_eval_command(const EvalCommand& command) {
  if (Status usable = check_json_file(command); !usable) return usable;
  return command.live ? evaluate_poses_as_published(command) : evaluate_trajectory(command);
}

}  // namespace swiftlet
