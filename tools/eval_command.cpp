// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/eval_command.hpp"

#include <cstdio>
#include <utility>

#include "daemon/outputs/file_writer.hpp"
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

Status write_figures(const EvalCommand& command, const std::string& text, const std::string& json) {
  const bool is_json_alone = command.json_file == "-";
  if (!command.json_file.empty() && !is_json_alone)
    if (Status written = write_file(command.json_file, json); !written) return written;
  std::fputs((is_json_alone ? json : text).c_str(), stdout);
  return {};
}

Status evaluate_poses_as_published(const EvalCommand& command) {
  std::vector<std::string> truths = command.truths;
  truths.insert(truths.end(), command.references.begin(), command.references.end());
  if (truths.size() > 1 || !command.relations.empty())
    return Error{ErrorCode::kInvalidInput, "eval --live: takes one reference at most, a true trajectory"};
  const Result<LiveEvaluation> evaluation = evaluate_live(
      {command.trajectory, truths.empty() ? "" : truths[0], command.config_file, command.batch_s});
  if (!evaluation) return evaluation.error();
  return write_figures(command, live_evaluation_text(*evaluation), live_evaluation_json(*evaluation));
}

/// Prints the notes of the captures. Their damage, in one line.
Status tell_notes(const Evaluation& evaluation) {
  std::string damage;
  for (const ReferenceResult& reference : evaluation.references) {
    const auto* flight = std::get_if<FlightResult>(&reference.figures);
    if (flight == nullptr) continue;
    for (const std::string& note : flight->input.notes)
      std::fprintf(stderr, "swiftlet: note: %s\n", note.c_str());
    for (const std::string& problem : flight->input.problems)
      damage += (damage.empty() ? "" : "; ") + problem;
  }
  if (damage.empty()) return {};
  return Error{ErrorCode::kDamaged, damage};
}

}  // namespace

Status run_eval_command(const EvalCommand& command) {
  if (command.live) return evaluate_poses_as_published(command);
  const Result<Evaluation> evaluation = evaluate(command);
  if (!evaluation) return evaluation.error();
  if (Status written = write_figures(command, evaluation_text(*evaluation), evaluation_json(*evaluation));
      !written)
    return written;
  return tell_notes(*evaluation);
}

}  // namespace swiftlet
