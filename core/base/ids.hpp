// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace swiftlet {

// Counted up from 0 within a run; never reused. Distinct types, so that one cannot be taken for another.
enum class KeyframeId : std::uint32_t {};
enum class LandmarkId : std::uint32_t {};
enum class ScanId : std::uint32_t {};
enum class TraversalId : std::uint32_t {};
enum class ClosureId : std::uint32_t {};
enum class FactorId : std::uint32_t {};
/// In the order in which they were first flown.
enum class StoreyId : std::uint8_t {};

/// A pose among those of one solver's problem, which are dense. Never leaves the solver.
enum class PoseIndex : std::uint32_t {};

template <typename T>
concept AnId = std::same_as<T, KeyframeId> || std::same_as<T, LandmarkId> || std::same_as<T, ScanId> ||
    std::same_as<T, TraversalId> || std::same_as<T, ClosureId> || std::same_as<T, FactorId> ||
    std::same_as<T, StoreyId> || std::same_as<T, PoseIndex>;

template <AnId Id>
constexpr std::uint32_t index_of(Id id) {
  return static_cast<std::uint32_t>(id);
}
/// From a plain number, never from another kind of id: tools/check_includes.py forbids that.
template <AnId Id>
constexpr Id make_id(std::size_t number) {
  return static_cast<Id>(number);
}

template <AnId Id>
constexpr Id operator+(Id id, std::uint32_t count) {
  return make_id<Id>(index_of(id) + count);
}
template <AnId Id>
constexpr Id operator-(Id id, std::uint32_t count) {
  return make_id<Id>(index_of(id) - count);
}
template <AnId Id>
constexpr std::uint32_t operator-(Id later, Id earlier) {
  return index_of(later) - index_of(earlier);
}
template <AnId Id>
constexpr Id& operator++(Id& id) {
  return id = id + 1;
}

/// Consecutive ids; some of them may have been erased.
template <AnId Id>
struct IdRange {
  Id first{};
  Id end{};  ///< one behind the last
  [[nodiscard]] constexpr bool empty() const { return first >= end; }
  [[nodiscard]] constexpr bool contains(Id id) const { return id >= first && id < end; }
  bool operator==(const IdRange&) const = default;
};

}  // namespace swiftlet
