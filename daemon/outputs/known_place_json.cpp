// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/known_place_json.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

/// A figure of so many: of none it is unknown, not 0.
Json known_of(std::size_t count, double figure) { return count > 0 ? Json(figure) : Json(nullptr); }

}  // namespace

Json known_place_json(const KnownPlaceError& error) {
  return {{"moments", error.moments},
          {"rms_m", known_of(error.moments, error.rms_m)},
          {"p95_m", known_of(error.moments, error.p95_m)},
          {"max_m", known_of(error.moments, error.max_m)},
          {"share_off", known_of(error.moments, error.share_off)},
          {"across_p95_m", number_or_null(error.across_p95_m)},
          {"along_p95_m", number_or_null(error.along_p95_m)},
          {"contacts", error.contacts},
          {"contacts_off", error.contacts_off},
          {"settled_p50_s", known_of(error.contacts_off, error.settled_p50_s)},
          {"jumps", error.jumps},
          {"greatest_jump_m", error.greatest_jump_m},
          {"map_rms_m",
           {number_or_null(error.map_rms_m[0]), number_or_null(error.map_rms_m[1]),
            number_or_null(error.map_rms_m[2])}}};
}

}  // namespace swiftlet
