// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/sample/attitude.hpp"
#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/session/log_session.hpp"

namespace swiftlet {

/// The distances of the Multiranger deck by variable, in the order of BeamLayout::multiranger().
inline constexpr std::array<const char*, 4> kRangeVariables{"range.front", "range.left", "range.back",
                                                            "range.right"};

/// Extracts from the vehicle's log records what samples need, by the names of the variables, from any blocks:
/// the four horizontal distances; the position (stateEstimate.x/y, kalman.stateX/Y or stateEstimateZ.x/y);
/// the yaw (stateEstimate.yaw, a quaternion of stateEstimate, kalman or stateEstimateZ, or stabilizer.yaw);
/// if there, the tilt (of such a quaternion, or roll and pitch of stateEstimate or stabilizer), the height
/// above the ground (range.zrange, or z of the position's groups), the barometer's altitude (baro.asl) and
/// whether the vehicle flies (supervisor.info, sys.isFlying, stabilizer.thrust). Each of the seven is taken
/// from one block: of those that run, the one with the most distances; of equals the one with the shortest
/// period, where all count as equal that are as short as kUsualPeriod; of equals the one with the lowest
/// number. Of blocks whose start was not seen, the first one received; of those of a description a better one
/// takes over when it comes. A block that falls silent for two seconds while others are heard counts as one
/// that does not run: the vehicle deletes blocks when its link is lost, and a client may start them anew by
/// other numbers. Names are resolved when a layout changes, not per packet: fixed storage. One thread at a
/// time; `session` must outlive it.
class ReadingExtractor {
 public:
  explicit ReadingExtractor(const LogSession& session) : session_(session) {}

  /// nullopt if the record holds nothing that samples need.
  [[nodiscard]] std::optional<Reading> extract(const LogRecord& record);

  /// The period of each, as the blocks were started; 0 when unknown.
  [[nodiscard]] Duration range_period() const { return period_of(range_source_); }
  [[nodiscard]] Duration odometry_period() const;
  [[nodiscard]] bool finds_ranges() const { return range_source_.has_value(); }
  [[nodiscard]] bool finds_position() const { return position_source_.has_value(); }
  [[nodiscard]] bool finds_yaw() const { return yaw_source_.has_value(); }
  /// Distances that the block with the ranges lacks; allocates.
  [[nodiscard]] std::vector<std::string> missing_ranges() const;

 private:
  using Slot = std::optional<std::uint8_t>;  ///< entry of a block
  enum class ValueKind : std::uint8_t {
    kNone,
    kMetres,
    kMillimetres,
    kDegrees,
    kQuaternion,
    kPackedQuaternion
  };
  /// Where a block holds a quantity, in which form; a quaternion as x, y, z, w.
  struct Quantity {
    ValueKind kind = ValueKind::kNone;
    std::array<Slot, 4> slots{};
    explicit operator bool() const { return kind != ValueKind::kNone; }
  };
  /// A form in which firmware logs a quantity.
  struct Form {
    ValueKind kind = ValueKind::kNone;
    std::size_t count = 0;
    std::array<std::string_view, 4> names;
  };
  /// What a block holds.
  struct Slots {
    bool resolved = false;
    std::array<Slot, 4> ranges{};
    std::size_t range_count = 0;
    Quantity position;
    Quantity yaw;
    Quantity tilt;
    Quantity height;
    Quantity altitude;
    Slot flying;
    unsigned flying_mask = 0;
  };
  struct Source {
    std::uint8_t block_id = 0;
    Duration period{};
    std::size_t offered = 0;  ///< of the ranges their number, else 1
  };
  /// stateEstimateZ.x counts millimetres in 16 bits and wraps at 32.767 m: made continuous again.
  struct WrappedMillimetres {
    std::int64_t value_mm = 0;
    double unwrap_m(double wrapped_mm);
  };

  const Slots& slots_of(const LogRecord& record);
  const Slots& slots_of_running(std::uint8_t block_id);
  void resolve(const LogRecord& record, Slots& slots) const;
  void resolve_flying(const LogRecord& record, Slots& slots) const;
  /// The first form that the block holds whole.
  [[nodiscard]] Quantity find_first(const LogRecord& record, std::span<const Form> forms) const;
  [[nodiscard]] Slot find(const LogRecord& record, std::string_view name) const;
  /// Whether this record's block holds the quantity and is the one that it is taken from.
  bool takes(std::optional<Source>& source, const LogRecord& record, Quantity Slots::*quantity);
  template <typename Offers>
  bool take_from(std::optional<Source>& source, const LogRecord& record, Offers offers);
  template <typename Offers>
  [[nodiscard]] Source source_for(const Source& own, Offers offers);
  [[nodiscard]] static bool is_better(const Source& source, const Source& than);
  [[nodiscard]] bool is_silent(const Source& source) const;
  void listen(const LogRecord& record);
  static Duration period_of(const std::optional<Source>& source);
  Point2 read_position(const LogRecord& record, const Quantity& position);
  static double read_yaw_rad(const LogRecord& record, const Quantity& yaw);
  static BodyTilt read_tilt(const LogRecord& record, const Quantity& tilt);
  double read_height_m(const LogRecord& record, const Quantity& height);
  /// Precondition: one of the two kinds. NaN: requested in a type that cannot hold it.
  static Quaternion read_quaternion(const LogRecord& record, const Quantity& quantity);

  static const std::array<Form, 3> kPositionForms;
  static const std::array<Form, 5> kYawForms;
  static const std::array<Form, 5> kTiltForms;
  static const std::array<Form, 4> kHeightForms;
  static const std::array<Form, 1> kAltitudeForms;

  const LogSession& session_;
  std::uint32_t revision_ = 0;
  std::array<Slots, 256> slots_{};
  std::optional<Source> range_source_;
  std::optional<Source> position_source_;
  std::optional<Source> yaw_source_;
  std::optional<Source> tilt_source_;
  std::optional<Source> height_source_;
  std::optional<Source> altitude_source_;
  std::optional<Source> flying_source_;
  WrappedMillimetres x_;
  WrappedMillimetres y_;
  std::optional<HostTime> newest_at_;
  Duration heard_{};                      // how long records have come, pauses of all left out
  std::array<Duration, 256> heard_at_{};  // by heard_, each block last, or when the layouts changed
  std::optional<HostTime> height_since_;  // in millimetres, its first value
  bool has_height_ = false;               // that was not 0
};

}  // namespace swiftlet
