// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/link_condition.hpp"

#include "core/base/check.hpp"

namespace swiftlet {

std::string_view describe(LinkCondition condition) {
  switch (condition) {
    case LinkCondition::kNone:
      return "no live link: a recording or a simulation";
    case LinkCondition::kConnected:
      return "connected: the vehicle answers";
    case LinkCondition::kSilent:
      return "the vehicle does not answer: is it on and in range, are channel, data rate and address right?";
    case LinkCondition::kDeviceMissing:
      return "the USB device (Crazyradio or vehicle on a cable) is not there: plug it in, after a connection "
             "the same one";
    case LinkCondition::kAccessDenied:
      return "the USB device may not be opened by this user: install the udev rule, join group plugdev, log "
             "in "
             "again";
    case LinkCondition::kDeviceBusy:
      return "another program has the USB device: close it (cfclient or another client)";
    case LinkCondition::kDeviceStalls:
      return "the USB device refuses transfers (stall): unplug it and plug it in again; Crazyradio firmware "
             "must be 0.40 or newer";
    case LinkCondition::kDeviceOverflows:
      return "the USB device sends more than it may (overflow): unplug it and plug it in again, without a "
             "hub";
    case LinkCondition::kDeviceMute:
      return "the USB device does not answer in time: unplug it and plug it in again, into a USB 2 port";
    case LinkCondition::kDeviceFault:
      return "the USB device fails (I/O error): unplug it and plug it in again, without a hub or into a "
             "USB 2 port";
    case LinkCondition::kDeviceUnsuited:
      return "a Crazyradio 2.0 has neither 250K nor channels above 100: set the vehicle to 1M or 2M and a "
             "channel up to 100, or use a Crazyradio PA";
  }
  SWIFTLET_CHECK(false, "every condition has its line");
}

LinkCondition condition_of(UsbOutcome failure) {
  switch (failure) {
    case UsbOutcome::kNoDevice:
      return LinkCondition::kDeviceMissing;
    case UsbOutcome::kAccessDenied:
      return LinkCondition::kAccessDenied;
    case UsbOutcome::kBusy:
      return LinkCondition::kDeviceBusy;
    case UsbOutcome::kTimeout:
      return LinkCondition::kDeviceMute;
    case UsbOutcome::kStall:
      return LinkCondition::kDeviceStalls;
    case UsbOutcome::kOverflow:
      return LinkCondition::kDeviceOverflows;
    case UsbOutcome::kFault:
      return LinkCondition::kDeviceFault;
    case UsbOutcome::kUnsuited:
      return LinkCondition::kDeviceUnsuited;
    case UsbOutcome::kDone:
      break;
  }
  SWIFTLET_CHECK(false, "only failures are asked about");
}

}  // namespace swiftlet
