// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "core/base/check.hpp"

namespace swiftlet {

/// The kind of an error, for code that branches on it; the message is for people.
enum class ErrorCode {
  kInvalidInput,    ///< a file, URI, option or configuration that cannot be used as it is
  kNotFound,        ///< the named file, device or entry does not exist
  kDamaged,         ///< the beginning was usable, the rest is not
  kEndOfRecording,  ///< a replay has delivered all its data; not a fault
  kTimeout,         ///< nothing received in time; try again
  kOutOfSpace,      ///< a disk or a fixed store is full
  kSolver,          ///< a numerical solve failed
};

/// An error as a value. The message is one line: what, where and what to do.
struct Error {
  ErrorCode code = ErrorCode::kInvalidInput;
  std::string message;
};

/// A value or an error. Returned by everything that depends on the outside (radio, USB, files) or on a
/// solver.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(*-explicit-*)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(*-explicit-*)

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// Precondition: ok().
  [[nodiscard]] const T& value() const& {
    SWIFTLET_CHECK(ok(), "value() needs a Result with a value");
    return std::get<0>(state_);
  }
  [[nodiscard]] T& value() & {
    SWIFTLET_CHECK(ok(), "value() needs a Result with a value");
    return std::get<0>(state_);
  }
  [[nodiscard]] T&& value() && {
    SWIFTLET_CHECK(ok(), "value() needs a Result with a value");
    return std::move(std::get<0>(state_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  /// Precondition: !ok().
  [[nodiscard]] const Error& error() const {
    SWIFTLET_CHECK(!ok(), "error() needs a Result with an error");
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// Success or an error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)), failed_(true) {}  // NOLINT(*-explicit-*)

  [[nodiscard]] bool ok() const { return !failed_; }
  explicit operator bool() const { return ok(); }
  /// Precondition: !ok().
  [[nodiscard]] const Error& error() const {
    SWIFTLET_CHECK(failed_, "error() needs a Status with an error");
    return error_;
  }

 private:
  Error error_;
  bool failed_ = false;
};

}  // namespace swiftlet
