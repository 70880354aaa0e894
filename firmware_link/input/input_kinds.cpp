// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <array>
#include <utility>

#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/libusb_bus.hpp"
#include "firmware_link/link/radio_link.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/link/udp_link.hpp"
#include "firmware_link/link/uri_text.hpp"
#include "firmware_link/link/usb_cable_link.hpp"
#include "firmware_link/simulation/address.hpp"
#include "firmware_link/simulation/link.hpp"

namespace swiftlet {
namespace {

constexpr int kLastUsbIndex = 99;

template <typename Address, Result<Address> (*kParse)(std::string_view)>
Status parsed_by(std::string_view text, std::any& address) {
  Result<Address> parsed = kParse(text);
  if (!parsed) return parsed.error();
  address = std::move(parsed).value();
  return {};
}

Result<UsbCableAddress> parse_usb_cable(std::string_view text) {
  const std::optional<int> index = whole_number(text, 0, kLastUsbIndex);
  if (!index) return bad_address("the vehicle " + in_quotes(text) + " must be a whole number from 0 to 99");
  return UsbCableAddress{*index};
}

Result<InputFile> parse_file(std::string_view text) {
  if (text.empty()) return bad_address("names no file");
  return InputFile{std::string(text)};
}

Result<LinkInput> input_on_usb() {
  Result<std::unique_ptr<UsbBus>> bus = LibusbBus::open();
  if (!bus) return bus.error();
  LinkInput input;
  input.clock = std::make_shared<SystemLinkClock>();
  input.usb_bus = std::move(bus).value();
  return input;
}

Result<LinkInput> open_radio(const std::any& address) {
  Result<LinkInput> input = input_on_usb();
  if (input)
    input->link = std::make_unique<RadioLink>(*input->usb_bus, *input->clock,
                                              std::any_cast<const RadioAddress&>(address));
  return input;
}

Result<LinkInput> open_usb_cable(const std::any& address) {
  Result<LinkInput> input = input_on_usb();
  if (input)
    input->link = std::make_unique<UsbCableLink>(*input->usb_bus, *input->clock,
                                                 std::any_cast<const UsbCableAddress&>(address).index);
  return input;
}

Result<LinkInput> open_udp(const std::any& address) {
  const auto& [host, port] = std::any_cast<const UdpAddress&>(address);
  LinkInput input;
  input.clock = std::make_shared<SystemLinkClock>();
  Result<std::unique_ptr<UdpLink>> link = UdpLink::open(host, port, *input.clock);
  if (!link) return link.error();
  input.link = std::move(link).value();
  return input;
}

Result<LinkInput> open_simulation(const std::any& address) {
  const auto& [world, seed, laps, faults, spared] = std::any_cast<const SimulationAddress&>(address);
  Result<std::unique_ptr<SimulatedLink>> link = SimulatedLink::open(world, seed, laps, spared);
  if (!link) return link.error();
  Result<PoseFile> truth = PoseFile::open();
  if (!truth) return truth.error();
  LinkInput input;
  SimulatedLink& simulated = **link;
  if (const std::string_view kind = simulated.world().kind; !kind.empty())
    input.notes.push_back("kind of building: " + std::string(kind));
  input.progress = [&simulated] { return std::optional<double>(simulated.progress()); };
  input.truth = KnownTruth{[&simulated](DeviceTime at) { return simulated.T_world_body(at); },
                           std::move(truth).value()};
  input.link = std::move(link).value();
  return input;
}

CaptureVehicle radio_vehicle(const std::any& address) {
  const auto& radio = std::any_cast<const RadioAddress&>(address);
  CaptureVehicle vehicle;
  std::ranges::copy(radio.address, vehicle.address.begin());
  vehicle.channel = radio.channel;
  return vehicle;
}

/// The layout knows radio and USB only: what comes another way counts as USB, and its serial number is its
/// name in ASCII, cut off at 12 characters or filled up with zeros.
CaptureVehicle vehicle_named(const std::string& name) {
  CaptureVehicle vehicle;
  vehicle.kind = CaptureLinkKind::kUsb;
  std::ranges::copy(name.substr(0, vehicle.address.size()), vehicle.address.begin());
  return vehicle;
}
CaptureVehicle usb_vehicle(const std::any& address) {
  return vehicle_named("usb:" + std::to_string(std::any_cast<const UsbCableAddress&>(address).index));
}
CaptureVehicle udp_vehicle(const std::any& address) {
  return vehicle_named("udp:" + std::to_string(std::any_cast<const UdpAddress&>(address).port));
}
CaptureVehicle simulated_vehicle(const std::any& address) {
  return vehicle_named("sim:" + std::any_cast<const SimulationAddress&>(address).world);
}

constexpr std::array kInputKinds{
    InputKind{.nature = InputNature::kVehicle,
              .scheme = "radio://",
              .form = "DONGLE/CHANNEL/RATE/ADDRESS",
              .example = "radio://0/80/2M/E7E7E7E7E7",
              .parse = parsed_by<RadioAddress, parse_radio_address>,
              .open = open_radio,
              .recorded_vehicle = radio_vehicle},
    InputKind{.nature = InputNature::kVehicle,
              .scheme = "usb://",
              .form = "N",
              .example = "usb://0",
              .parse = parsed_by<UsbCableAddress, parse_usb_cable>,
              .open = open_usb_cable,
              .recorded_vehicle = usb_vehicle},
    InputKind{.nature = InputNature::kVehicle,
              .scheme = kUdpScheme,
              .form = "HOST:PORT",
              .example = kLocalUdpUri,
              .parse = parsed_by<UdpAddress, parse_udp_address>,
              .open = open_udp,
              .recorded_vehicle = udp_vehicle},
    InputKind{.nature = InputNature::kSimulation,
              .scheme = "sim://",
              .form = "WORLD?seed=N&laps=N",
              .example = "sim://office?seed=1",
              .parse = parsed_by<SimulationAddress, parse_simulation_address>,
              .open = open_simulation,
              .recorded_vehicle = simulated_vehicle},
    InputKind{.nature = InputNature::kFile,
              .scheme = "replay:",
              .form = "FILE",
              .example = "replay:flight.pcap",
              .parse = parsed_by<InputFile, parse_file>},
    InputKind{.nature = InputNature::kFollowed,
              .scheme = "follow:",
              .form = "FILE",
              .example = "follow:flight.pcap",
              .parse = parsed_by<InputFile, parse_file>},
};

}  // namespace

std::span<const InputKind> input_kinds() { return kInputKinds; }

}  // namespace swiftlet
