// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

namespace swiftlet {

// A Tuning struct holds the constants of one algorithm that are no settings: results should hardly depend on
// them. Each value is described and has its unit in its name. The struct has the TuningValue of each as
// `kValues`, so that an experiment can count them and set them from outside.

template <typename Tuning>
struct TuningValue {
  std::string_view name;
  std::variant<int Tuning::*, double Tuning::*, std::size_t Tuning::*> member;
};

}  // namespace swiftlet
