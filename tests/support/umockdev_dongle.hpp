// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <memory>

#include "tests/support/emulated_crazyradio.hpp"

namespace swiftlet {

/// An emulated Crazyradio that the real libusb finds, opens and talks to, in real time: libumockdev answers
/// for the kernel. The program must run under umockdev-wrapper. At most one at a time. Calls from one thread;
/// the dongle lives on one of libumockdev's.
class UmockdevDongle {
 public:
  /// Whether this program runs under umockdev-wrapper.
  [[nodiscard]] static bool is_possible();

  /// Plugged in. `dongle`, and the receiver and vehicle behind it, must outlive it and are touched through
  /// with() alone meanwhile.
  explicit UmockdevDongle(EmulatedCrazyradio& dongle);
  ~UmockdevDongle();
  UmockdevDongle(const UmockdevDongle&) = delete;
  UmockdevDongle& operator=(const UmockdevDongle&) = delete;

  /// Does something to the dongle, its receiver or its vehicle while nobody else does.
  void with(const std::function<void(EmulatedCrazyradio&)>& action);
  /// The system notices, and notifies the programs that listen for it.
  void unplug();
  void plug_in();
  /// Whether the calling thread may open the device's file, also where it runs as root.
  void set_access(bool allowed);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet
