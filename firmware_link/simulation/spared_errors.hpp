// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <bitset>
#include <cstddef>
#include <string_view>

#include "core/base/result.hpp"
#include "firmware_link/simulation/vehicle.hpp"

namespace swiftlet {

/// Errors of the sensors that a simulated flight is spared: what each of them costs is the difference. All
/// else, noise included, stays as the seed draws it. The names are those of docs/simulated_buildings.md.
class SparedErrors {
 public:
  /// `NAME,NAME`. Error: kInvalidInput: there is no such error; the message lists them.
  [[nodiscard]] static Result<SparedErrors> parse(std::string_view text);

  void take_from(VehicleModel& model) const;

 private:
  static constexpr std::size_t kErrors = 12;
  std::bitset<kErrors> is_spared_;

  struct Named {
    std::string_view name;
    void (*take_from)(VehicleModel&);
  };
  static const Named kNamed[kErrors];
};

}  // namespace swiftlet
