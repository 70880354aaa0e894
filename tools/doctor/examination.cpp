// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/examination.hpp"

#include <array>
#include <cstdio>
#include <optional>

#include "firmware_link/link/link_condition.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "tools/doctor/lcm_checks.hpp"
#include "tools/doctor/real_time_checks.hpp"
#include "tools/doctor/storage_checks.hpp"
#include "tools/doctor/usb_checks.hpp"
#include "tools/doctor/vehicle_checks.hpp"
#include "tools/doctor/vehicle_interview.hpp"

namespace swiftlet {
namespace {

void append(Findings& findings, Findings more) {
  findings.insert(findings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}
void skip(Findings& findings, std::initializer_list<const char*> checks, const std::string& why) {
  for (const char* check : checks) findings.push_back({Mark::kSkipped, check, why, ""});
}

/// Whether the device may be opened, is free and stays awake. True: it can be used.
bool check_access(const Surroundings& around, const UsbIdentity& device, Findings& findings) {
  const Finding permission = check_permission(device, around.files);
  findings.push_back(permission);
  findings.push_back(permission.mark == Mark::kOk
                         ? check_in_use(*around.usb_bus, device, around.files)
                         : Finding{Mark::kSkipped, "in use", "it may not be opened", ""});
  const bool usable = findings.back().mark == Mark::kOk;
  findings.push_back(check_usb_power(device, around.files));
  return usable;
}

bool check_radio(const RadioAddress& radio, const Surroundings& around, Findings& findings) {
  const PluggedIn plugged_in = around.usb_bus != nullptr ? look_at_bus(*around.usb_bus) : PluggedIn{};
  findings.push_back(plugged_in.vehicles.empty()
                         ? Finding{Mark::kSkipped, "cable", "radio:// needs none", ""}
                         : Finding{Mark::kOk, "cable",
                                   "a vehicle is on its cable too; a program that uses it silences its radio",
                                   ""});
  findings.push_back(check_dongle(plugged_in, radio, around.files));
  const std::optional<UsbIdentity> dongle = named_dongle(plugged_in, radio);
  if (!dongle) {
    skip(findings, {"dongle firmware", "permission", "in use", "usb power"}, "no dongle");
    return false;
  }
  const Finding firmware = check_dongle_firmware(*dongle);
  findings.push_back(firmware);
  return check_access(around, *dongle, findings) && firmware.mark != Mark::kProblem;
}

bool check_usb_cable(const UsbCableAddress& cable, const Surroundings& around, Findings& findings) {
  const PluggedIn plugged_in = around.usb_bus != nullptr ? look_at_bus(*around.usb_bus) : PluggedIn{};
  skip(findings, {"dongle", "dongle firmware"}, "usb:// needs none");
  findings.push_back(check_cable(plugged_in, cable.index, around.files));
  const std::optional<UsbIdentity> vehicle = named_vehicle(plugged_in, cable.index);
  if (vehicle) return check_access(around, *vehicle, findings);
  skip(findings, {"permission", "in use", "usb power"}, "no cable");
  return false;
}

/// True: the way to the vehicle is open.
bool check_devices(const InputUri& uri, const Surroundings& around, Findings& findings) {
  if (const auto* radio = uri.as<RadioAddress>()) return check_radio(*radio, around, findings);
  if (const auto* cable = uri.as<UsbCableAddress>()) return check_usb_cable(*cable, around, findings);
  const bool is_vehicle = uri.is(InputNature::kVehicle);
  skip(findings, {"cable", "dongle", "dongle firmware", "permission", "in use", "usb power"},
       is_vehicle ? std::string(uri.kind->scheme) + " needs none" : "recordings and simulations need none");
  return is_vehicle;
}

std::string uri_of(const RadioAddress& radio) {
  constexpr std::array<const char*, 3> kRates{"250K", "1M", "2M"};
  char address[11];
  std::snprintf(address, sizeof address, "%02X%02X%02X%02X%02X", radio.address[0], radio.address[1],
                radio.address[2], radio.address[3], radio.address[4]);
  return "radio://" + radio.dongle + '/' + std::to_string(radio.channel) + '/' +
         kRates[static_cast<std::size_t>(radio.rate)] + '/' + address;
}

Finding nobody_on_radio(const RadioAddress& radio, const Surroundings& around) {
  constexpr const char* kSwitchOn = "switch the vehicle on and bring it near";
  std::string uris;
  for (const RadioAddress& other : around.scan(radio)) uris += ' ' + uri_of(other);
  if (uris.empty())
    return {Mark::kProblem, "vehicle",
            "no answer at " + uri_of(radio) + ", nor to this address on any other channel and rate",
            kSwitchOn};
  return {Mark::kProblem, "vehicle", "no answer at " + uri_of(radio) + ", but at" + uris,
          "use what was found if it is yours; if not, " + std::string(kSwitchOn)};
}

/// The device's fault, not the vehicle's.
bool has_failed(LinkCondition condition) {
  return condition != LinkCondition::kNone && condition != LinkCondition::kConnected &&
         condition != LinkCondition::kSilent;
}

Finding nobody_answers(const InputUri& uri, LinkCondition condition, const Surroundings& around) {
  if (has_failed(condition)) return {Mark::kProblem, "vehicle", std::string(describe(condition)), ""};
  if (const auto* radio = uri.as<RadioAddress>()) return nobody_on_radio(*radio, around);
  if (uri.as<UsbCableAddress>() != nullptr)
    return {Mark::kProblem, "vehicle", "it does not answer by its cable", "switch it off and on again"};
  const auto* udp = uri.as<UdpAddress>();
  if (udp == nullptr) return {Mark::kProblem, "vehicle", "it does not answer", "switch it on"};
  const std::string place = udp->host + ':' + std::to_string(udp->port);
  return {Mark::kProblem, "vehicle", "nobody answers at " + place,
          "start the simulator: swiftlet sim --world office --udp " + place};
}

Result<VehicleFacts> ask_vehicle(const InputUri& uri, const Surroundings& around) {
  const Result<LinkInput> input = around.open_link(uri);
  if (!input) return input.error();
  return interview_vehicle(*input->link, *input->clock, around.cache);
}

void check_answers(const InputUri& uri, const Surroundings& around, Findings& findings) {
  const Result<VehicleFacts> facts = ask_vehicle(uri, around);
  if (!facts) {
    findings.push_back({Mark::kProblem, "vehicle", facts.error().message, "correct the URI"});
    return append(findings, skip_vehicle("no link"));
  }
  if (!facts->answered) {
    findings.push_back(nobody_answers(uri, facts->link, around));
    return append(findings, skip_vehicle("the vehicle does not answer"));
  }
  findings.push_back({Mark::kOk, "vehicle",
                      facts->device_type.empty() ? "it answers" : facts->device_type + " answers", ""});
  append(findings, check_vehicle(*facts));
}

}  // namespace

Findings examine(const InputUri& uri, const LcmUrl& lcm_url, const Surroundings& around) {
  Findings findings;
  if (check_devices(uri, around, findings)) {
    check_answers(uri, around, findings);
  } else {
    const char* why = uri.is(InputNature::kVehicle) ? "cannot be asked before that is solved" : "none here";
    skip(findings, {"vehicle"}, why);
    append(findings, skip_vehicle(why));
  }
  append(findings, check_lcm(lcm_url, around.network, around.files));
  append(findings, check_real_time(around.files));
  findings.push_back(check_storage(around.recording_directory));
  return findings;
}

}  // namespace swiftlet
