// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "core/base/check.hpp"

namespace swiftlet {

/// A list of fixed capacity with its storage inside; trivially copyable when T is, so it may cross a queue. A
/// full list refuses further items. Nothing here allocates.
template <typename T, std::size_t kCapacity>
class FixedVector {
  static_assert(kCapacity > 0, "a list has room for one item at least");

 public:
  using value_type = T;

  static constexpr std::size_t capacity() { return kCapacity; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == kCapacity; }

  constexpr T& operator[](std::size_t i) {
    SWIFTLET_CHECK(i < size_, "the index lies inside the list");
    return items_[i];
  }
  constexpr const T& operator[](std::size_t i) const {
    SWIFTLET_CHECK(i < size_, "the index lies inside the list");
    return items_[i];
  }
  constexpr T& back() { return (*this)[size_ - 1]; }
  constexpr const T& back() const { return (*this)[size_ - 1]; }
  constexpr T& front() { return (*this)[0]; }
  constexpr const T& front() const { return (*this)[0]; }

  constexpr T* data() { return items_.data(); }
  constexpr const T* data() const { return items_.data(); }
  constexpr T* begin() { return items_.data(); }
  constexpr T* end() { return items_.data() + size_; }
  constexpr const T* begin() const { return items_.data(); }
  constexpr const T* end() const { return items_.data() + size_; }

  /// False, and nothing changed, when full.
  [[nodiscard]] constexpr bool try_push_back(const T& item) {
    if (full()) return false;
    items_[size_++] = item;
    return true;
  }
  constexpr void clear() { size_ = 0; }
  /// Keeps the first `count` items. Precondition: count <= size().
  constexpr void truncate(std::size_t count) {
    SWIFTLET_CHECK(count <= size_, "truncating never grows");
    size_ = count;
  }
  /// Removes item `i`, keeping the order of the others.
  constexpr void erase(std::size_t i) {
    SWIFTLET_CHECK(i < size_, "the index lies inside the list");
    std::move(begin() + i + 1, end(), begin() + i);
    --size_;
  }
  /// Removes the first `count` items, keeping the order of the others.
  constexpr void erase_front(std::size_t count) {
    SWIFTLET_CHECK(count <= size_, "no more is removed than there is");
    std::move(begin() + count, end(), begin());
    size_ -= count;
  }

 private:
  std::array<T, kCapacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace swiftlet
