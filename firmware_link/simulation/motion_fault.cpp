// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/motion_fault.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {
namespace {

struct Kind {
  std::string_view name;
  MotionFaultKind kind{};
  double max = 0.0;  // of the amount; 0: it has none
};

constexpr double kMaxS = 3600.0;
constexpr double kMaxDegrees = 180.0;
constexpr std::array kFaultKinds{Kind{"silence", MotionFaultKind::kSilence, kMaxS},
                                 Kind{"reset", MotionFaultKind::kReset, 0.0},
                                 Kind{"restart", MotionFaultKind::kRestart, kMaxS},
                                 Kind{"carried", MotionFaultKind::kCarried, kMaxS},
                                 Kind{"teleport", MotionFaultKind::kTeleport, kMaxS},
                                 Kind{"slip", MotionFaultKind::kSlip, kMaxS},
                                 Kind{"jump", MotionFaultKind::kYawJump, kMaxDegrees},
                                 Kind{"turn", MotionFaultKind::kYawTurn, kMaxDegrees}};

std::optional<double> number(std::string_view text, double lowest, double highest) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool is_good = error == std::errc{} && stop == end && value >= lowest && value <= highest;
  return is_good ? std::optional(value) : std::nullopt;
}

Result<MotionFault> parse_fault(std::string_view text) {
  const std::string whole = in_quotes(text);
  const std::string_view name = cut_off(text, '@');
  const std::string_view seconds = cut_off(text, ':');
  const auto kind = std::ranges::find(kFaultKinds, name, &Kind::name);
  if (kind == kFaultKinds.end())
    return bad_address(
        "the fault " + whole +
        " must be silence, reset, restart, carried, teleport, slip, jump or turn, as in reset@60");
  const std::optional<double> after_s = number(seconds, 0.0, kMaxS);
  if (!after_s)
    return bad_address("the fault " + whole + " needs the seconds after which it begins, as in reset@60");
  MotionFault fault{kind->kind, from_seconds(*after_s), 0.0};
  if (kind->max == 0.0 && text.empty()) return fault;
  const bool turns = kind->kind == MotionFaultKind::kYawJump || kind->kind == MotionFaultKind::kYawTurn;
  const double min = turns ? -kind->max : 0.0;
  const std::optional<double> amount = number(text, min, kind->max);
  if (kind->max == 0.0 || !amount)
    return bad_address("the fault " + whole +
                       (kind->max == 0.0 ? " takes no amount"
                                         : " needs an amount, for how long or how far, as in silence@60:20"));
  fault.amount = *amount;
  return fault;
}

}  // namespace

Result<std::vector<MotionFault>> parse_motion_faults(std::string_view text) {
  std::vector<MotionFault> faults;
  while (!text.empty()) {
    const Result<MotionFault> fault = parse_fault(cut_off(text, ','));
    if (!fault) return fault.error();
    if (!faults.empty() && fault->after < faults.back().after)
      return bad_address("the faults must be in the order of time");
    faults.push_back(*fault);
  }
  if (faults.empty()) return bad_address("names no fault");
  return faults;
}

}  // namespace swiftlet
