// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

using Kind = VehicleEvent::Kind;

bool is_warning(const VehicleEvent& event) {
  return event.kind != Kind::kReadingTable && event.kind != Kind::kConnected &&
         event.kind != Kind::kClientConnected && event.kind != Kind::kClientGone;
}

namespace {

std::string describe_other_program(Kind kind, const std::string& value) {
  if (kind == Kind::kOtherProgram)
    return "another program talks to this vehicle: each takes the other's answers and log data; close it, "
           "or let it share the link (swiftletd --share)";
  if (kind == Kind::kDoubledData)
    return "log data arrives twice, and is used once: another program talks to this vehicle, or the network "
           "doubles packets";
  if (kind == Kind::kClientConnected)
    return "a client has connected from port " + value + " and has the vehicle";
  if (kind == Kind::kClientGone)
    return "the client is gone; its setpoints end with it, and the vehicle's own watchdog acts";
  if (kind == Kind::kClientBlocksLost)
    return "the client's log blocks are gone, because the vehicle's log had to begin anew: let the client "
           "connect again";
  return "a second client, from port " + value + ", is refused: one at a time";
}

}  // namespace

std::string describe(const VehicleEvent& event) {
  const std::string value = std::to_string(event.value);
  switch (event.kind) {
    case Kind::kReadingTable:
      return "reading the vehicle's table of contents, " + value + " % so far; once only for each firmware";
    case Kind::kConnected:
      return "connected to the vehicle, CRTP protocol " + value + "; log data flows";
    case Kind::kProtocolNewer:
      return "the vehicle's firmware has CRTP protocol " + value +
             ", newer than the newest known; if samples look wrong, update swiftlet";
    case Kind::kDataStopped:
      return "no log data for a second; the map is kept, and the session restarts when the vehicle is "
             "received";
    case Kind::kRebooted:
      return "the vehicle has rebooted; its dead reckoning restarts, the map is kept";
    case Kind::kRefused:
      return "this vehicle cannot be used; swiftlet doctor reports why; trying again";
    case Kind::kNoMultiranger:
      return "the vehicle finds no Multiranger deck (deck.bcMultiranger is 0), so there are no ranges: check "
             "how it is mounted and restart the vehicle";
    case Kind::kNoFlowDeck:
      return "the vehicle finds no Flow deck (deck.bcFlow2 is 0), so it does not know how it moves: check "
             "how it is mounted and restart the vehicle";
    case Kind::kYawTrap:
      return "the vehicle moves with its motors off: its firmware then pulls the yaw back to the initial one "
             "within seconds, and the map will be wrong; fly, or do not turn";
    case Kind::kBatteryLow:
      return "the vehicle's battery is low (" + value + " mV): land";
    case Kind::kHeadingLeapt:
      return "the heading of the dead reckoning leapt as no vehicle can turn, " + value +
             " times so far; these turns are left out";
    case Kind::kRangesFrozen:
      return "none of the ranges has changed for two seconds: a range sensor hangs, and what is mapped now "
             "is "
             "wrong; land and restart the vehicle";
    case Kind::kOtherProgram:
    case Kind::kDoubledData:
    case Kind::kClientConnected:
    case Kind::kClientGone:
    case Kind::kClientRefused:
    case Kind::kClientBlocksLost:
      return describe_other_program(event.kind, value);
  }
  return {};
}

}  // namespace swiftlet
