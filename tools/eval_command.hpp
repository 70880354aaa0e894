// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"

namespace swiftlet {

/// What `swiftlet eval` was asked to do.
struct EvalCommand {
  std::string trajectory;               ///< a TUM file; of `live` an input, which is mapped
  std::vector<std::string> references;  ///< of kinds that show, see recognise_reference()
  std::vector<std::string> relations;   ///< references that are relations, whatever they look like
  std::vector<std::string> truths;      ///< references that are TUM trajectories, whatever they look like
  bool live = false;                    ///< evaluate poses as published; references: a true path at most
  std::optional<double> batch_s;        ///< of `live`: compare with final passes at moments this far apart
  std::string config_file;              ///< of `live`; empty: the defaults
  bool calibrate = true;                ///< of `live`
  std::string json_file;                ///< empty: none; "-": to stdout, in place of the table
};

/// Holds the trajectory against each reference. The figures go to stdout, notes of a capture or, of `live`,
/// of the input to stderr.
///
/// Errors: kInvalidInput, kNotFound: no reference given, a file cannot be used or has no stamp in common with
/// the trajectory, or the JSON file cannot be written or is one of the inputs, which is asked first; nothing
/// was written. kDamaged: capture or input is damaged after usable samples, and the figures come from the
/// rest; or a reference is damaged, and nothing was written. kOutOfSpace: the JSON file was not written.
[[nodiscard]] Status run_eval_command(const EvalCommand& command);

}  // namespace swiftlet
