// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/ids.hpp"

namespace swiftlet {

/// A set of ids as ranges, ascending, those that touch merged. Allocates.
template <AnId Id>
class IdRanges {
 public:
  IdRanges() = default;
  /// Precondition: the range begins at or behind the end of the one before it. An empty one changes nothing.
  void add(IdRange<Id> range) {
    if (range.empty()) return;
    SWIFTLET_CHECK(ranges_.empty() || range.first >= ranges_.back().end, "ranges are in order");
    if (!ranges_.empty() && range.first == ranges_.back().end) {
      ranges_.back().end = range.end;
    } else {
      ranges_.push_back(range);
    }
  }
  void add(Id id) { add({id, id + 1}); }
  [[nodiscard]] bool contains(Id id) const {
    const auto behind =
        std::upper_bound(ranges_.begin(), ranges_.end(), id,
                         [](Id value, const IdRange<Id>& range) { return value < range.first; });
    return behind != ranges_.begin() && std::prev(behind)->contains(id);
  }
  [[nodiscard]] bool empty() const { return ranges_.empty(); }
  [[nodiscard]] auto begin() const { return ranges_.begin(); }
  [[nodiscard]] auto end() const { return ranges_.end(); }

 private:
  std::vector<IdRange<Id>> ranges_;
};

/// What belongs to ids that are given once, in ascending order. Values lie in one array, in the order of
/// their ids; a table of holes leads from an id to its position there. Lookup: O(1) while nothing was erased,
/// then O(log holes). Allocates.
template <AnId Id, typename T>
class IdMap {
  struct Hole {
    Id first{};
    Id end{};
    std::uint32_t erased = 0;  // ids before `end`
  };

 public:
  IdMap() = default;
  /// Values of the ids from 0.
  explicit IdMap(std::vector<T> values) : values_(std::move(values)), end_(make_id<Id>(values_.size())) {}

  /// Gives the next id.
  Id push_back(T value) {
    values_.push_back(std::move(value));
    const Id id = end_;
    ++end_;
    return id;
  }
  /// Gives no id before this one.
  void skip_to(Id id) {
    if (id <= end_) return;
    if (holes_.empty() || holes_.back().end < end_) holes_.push_back({end_, end_, erased()});
    holes_.back().end = id;
    holes_.back().erased += id - end_;
    end_ = id;
  }
  /// Erases what is left of these ids. Their ids are not given again. Precondition: all were given.
  void erase(const IdRanges<Id>& gone);
  void erase(IdRange<Id> gone) {
    IdRanges<Id> ranges;
    ranges.add(gone);
    erase(ranges);
  }
  template <typename Predicate>
  void erase_if(Predicate is_gone) {
    IdRanges<Id> gone;
    for (std::size_t i = 0; i < size(); ++i)
      if (is_gone(std::as_const(values_[i]))) gone.add(id_at(i));
    erase(gone);
  }

  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool contains(Id id) const {
    if (id >= end_) return false;
    const std::size_t behind = holes_behind(id);
    return behind == 0 || id >= holes_[behind - 1].end;
  }
  /// Precondition: it was not erased.
  [[nodiscard]] T& operator[](Id id) { return values_[held_position(id)]; }
  [[nodiscard]] const T& operator[](Id id) const { return values_[held_position(id)]; }

  /// The id that is given next.
  [[nodiscard]] Id end_id() const { return end_; }
  /// Precondition of both: not empty.
  [[nodiscard]] Id first_id() const { return id_at(0); }
  [[nodiscard]] Id last_id() const { return id_at(size() - 1); }
  /// The id itself or, where it was erased, the next that was not; end_id() where there is none.
  [[nodiscard]] Id at_or_after(Id id) const {
    const std::size_t behind = holes_behind(id);
    return behind == 0 ? id : std::max(id, holes_[behind - 1].end);
  }
  /// Its neighbours among the ids that were not erased. Precondition: there is one.
  [[nodiscard]] Id next(Id id) const { return at_or_after(id + 1); }
  [[nodiscard]] Id previous(Id id) const { return id_at(position(id) - 1); }

  /// All values, in the order of their ids.
  [[nodiscard]] std::span<T> values() { return values_; }
  [[nodiscard]] std::span<const T> values() const { return values_; }
  [[nodiscard]] std::span<const T> values(IdRange<Id> ids) const {
    return std::span<const T>(values_).subspan(position(ids.first), count(ids));
  }
  /// How many ids of the range were not erased.
  [[nodiscard]] std::size_t count(IdRange<Id> ids) const { return position(ids.end) - position(ids.first); }
  /// Where the value of an id lies in values(), or that of the next one that was not erased.
  [[nodiscard]] std::size_t position(Id id) const {
    const std::size_t behind = holes_behind(id);
    if (behind == 0) return index_of(id);
    const Hole& hole = holes_[behind - 1];
    return index_of(std::max(id, hole.end)) - hole.erased;
  }
  /// The other way; behind all values lies end_id().
  [[nodiscard]] Id id_at(std::size_t position) const {
    const auto behind = std::upper_bound(
        holes_.begin(), holes_.end(), position,
        [](std::size_t p, const Hole& hole) { return p < index_of(hole.end) - hole.erased; });
    return make_id<Id>(position + (behind == holes_.begin() ? 0 : std::prev(behind)->erased));
  }

  /// The same ids with other values, as many as these.
  template <typename U>
  [[nodiscard]] IdMap<Id, U> with(std::vector<U> values) const {
    SWIFTLET_CHECK(values.size() == size(), "one value an id");
    IdMap<Id, U> other(std::move(values));
    other.end_ = end_;
    for (const Hole& hole : holes_) other.holes_.push_back({hole.first, hole.end, hole.erased});
    return other;
  }

  /// Ids and values, for (const auto& [id, value] : map).
  class Iterator {
   public:
    struct Entry {
      Id id;
      const T& value;
    };
    Entry operator*() const { return {id_, map_->values_[position_]}; }
    Iterator& operator++() {
      ++position_;
      ++id_;
      skip_hole();
      return *this;
    }
    bool operator==(const Iterator& other) const { return position_ == other.position_; }

   private:
    friend class IdMap;
    Iterator(const IdMap& map, std::size_t position) : map_(&map), position_(position) { skip_hole(); }
    void skip_hole() {
      if (hole_ < map_->holes_.size() && map_->holes_[hole_].first == id_) id_ = map_->holes_[hole_++].end;
    }
    const IdMap* map_;
    std::size_t position_;
    std::size_t hole_ = 0;
    Id id_{};
  };
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  template <AnId, typename>
  friend class IdMap;

  /// How many holes begin at or before the id.
  [[nodiscard]] std::size_t holes_behind(Id id) const {
    if (holes_.empty()) return 0;
    const auto behind = std::upper_bound(holes_.begin(), holes_.end(), id,
                                         [](Id value, const Hole& hole) { return value < hole.first; });
    return static_cast<std::size_t>(behind - holes_.begin());
  }
  [[nodiscard]] std::size_t held_position(Id id) const {
    if (holes_.empty()) return index_of(id);
    const std::size_t behind = holes_behind(id);
    if (behind == 0) return index_of(id);
    const Hole& hole = holes_[behind - 1];
    SWIFTLET_CHECK(id >= hole.end, "the id was not erased");
    return index_of(id) - hole.erased;
  }
  [[nodiscard]] std::uint32_t erased() const { return holes_.empty() ? 0 : holes_.back().erased; }
  void add_holes(const IdRanges<Id>& gone);

  std::vector<T> values_;
  std::vector<Hole> holes_;  // ascending; none touch
  Id end_{};
};

template <AnId Id, typename T>
void IdMap<Id, T>::erase(const IdRanges<Id>& gone) {
  if (gone.empty()) return;
  SWIFTLET_CHECK(std::prev(gone.end())->end <= end_, "ids that are erased were given");
  const auto at = [this](std::size_t position) {
    return values_.begin() + static_cast<std::ptrdiff_t>(position);
  };
  auto to = at(position(gone.begin()->first));
  for (auto range = gone.begin(); range != gone.end(); ++range) {
    const auto kept_until =
        std::next(range) == gone.end() ? values_.end() : at(position(std::next(range)->first));
    to = std::move(at(position(range->end)), kept_until, to);
  }
  values_.erase(to, values_.end());
  add_holes(gone);
}

/// Merges two ascending lists of holes, which may overlap.
template <AnId Id, typename T>
void IdMap<Id, T>::add_holes(const IdRanges<Id>& gone) {
  std::vector<IdRange<Id>> all;
  for (const Hole& hole : holes_) all.push_back({hole.first, hole.end});
  all.insert(all.end(), gone.begin(), gone.end());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  holes_.clear();
  for (const IdRange<Id>& range : all) {
    if (holes_.empty() || range.first > holes_.back().end) {
      holes_.push_back({range.first, range.end, 0});
    } else {
      holes_.back().end = std::max(holes_.back().end, range.end);
    }
  }
  std::uint32_t erased = 0;
  for (Hole& hole : holes_) hole.erased = erased += hole.end - hole.first;
}

}  // namespace swiftlet
