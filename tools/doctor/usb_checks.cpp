// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/usb_checks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <variant>

#include "firmware_link/link/crazyradio.hpp"
#include "firmware_link/link/usb_cable_link.hpp"
#include "tools/doctor/device_holder.hpp"

namespace swiftlet {
namespace {

constexpr std::uint16_t kCrazyradioBootLoader = 0x0101;

// Of Crazyradio PA, which counts in the low byte: 0x0053 is 0.53. Crazyradio 2.0 counts in both: 0x0504
// is 5.4.
constexpr std::uint16_t kNewestOfPa = 0x0053;
constexpr std::uint16_t kFirstOfRadio2 = 0x0300;
constexpr std::uint16_t kAdvisedOfRadio2 = 0x0504;

constexpr const char* kNoUsb = ": this system shows no USB at all";
constexpr const char* kHandThrough = "in a virtual machine or container, hand the device through to it";

constexpr const char* kInstallRule = "run tools/install-udev-rule in swiftlet's source directory";

std::string version_text(std::uint16_t release_bcd) {
  char text[8];
  std::snprintf(text, sizeof text, "%x.%x", unsigned{release_bcd} >> 8, unsigned{release_bcd} & 0xFFU);
  return text;
}

std::string place_of(const UsbIdentity& device) {
  return "bus " + std::to_string(device.bus) + " device " + std::to_string(device.address);
}

bool is_radio2(const UsbIdentity& dongle) { return dongle.name.find("2.0") != std::string::npos; }

/// The serial number where it could be read, else the place.
std::string description_of(const UsbIdentity& device, const std::string& name) {
  return name + (device.serial.empty() ? "" : ", serial " + device.serial) + ", " + place_of(device);
}
std::string dongle_text(const UsbIdentity& dongle) {
  return description_of(dongle, dongle.name.empty() ? "Crazyradio" : dongle.name);
}

bool has_rule(const SystemFiles& files) {
  constexpr std::array<const char*, 5> kDirectories{"/etc/udev/rules.d", "/run/udev/rules.d",
                                                    "/usr/local/lib/udev/rules.d", "/usr/lib/udev/rules.d",
                                                    "/lib/udev/rules.d"};
  return std::any_of(kDirectories.begin(), kDirectories.end(), [&files](const std::string& directory) {
    const std::vector<std::string> names = files.names_in(directory);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const std::string text = files.read(directory + '/' + name).value_or("");
      return text.find("\"1915\"") != std::string::npos && text.find("\"7777\"") != std::string::npos;
    });
  });
}

/// The device's directory in /sys.
std::optional<std::string> sysfs_of(const UsbIdentity& device, const SystemFiles& files) {
  for (const std::string& name : files.names_in("/sys/bus/usb/devices")) {
    std::string path = "/sys/bus/usb/devices/" + name;
    if (files.read_number(path + "/busnum") == device.bus &&
        files.read_number(path + "/devnum") == device.address)
      return path;
  }
  return std::nullopt;
}

Finding no_such_dongle(const PluggedIn& plugged_in, const RadioAddress& radio) {
  std::string serials;
  for (const UsbIdentity& dongle : plugged_in.dongles)
    serials += (serials.empty() ? "" : ", ") + (dongle.serial.empty() ? place_of(dongle) : dongle.serial);
  const std::size_t number = plugged_in.dongles.size();
  return {Mark::kProblem, "dongle",
          "no dongle '" + radio.dongle + "', but " + std::to_string(number) + " plugged in: " + serials,
          "write radio://0/..., or one of these serial numbers in the place of the 0"};
}

}  // namespace

PluggedIn look_at_bus(UsbBus& bus) {
  return {.dongles = bus.list(kCrazyradioVendor, kCrazyradioProduct),
          .boot_loaders = bus.list(kCrazyradioVendor, kCrazyradioBootLoader),
          .vehicles = vehicles_on_cables(bus)};
}

std::optional<UsbIdentity> named_dongle(const PluggedIn& plugged_in, const RadioAddress& radio) {
  const std::vector<UsbIdentity> named = dongles_named(radio.dongle, plugged_in.dongles);
  return named.empty() ? std::nullopt : std::optional(named.front());
}

std::optional<UsbIdentity> named_vehicle(const PluggedIn& plugged_in, int index) {
  const auto place = static_cast<std::size_t>(index);
  if (index < 0 || place >= plugged_in.vehicles.size()) return std::nullopt;
  return plugged_in.vehicles[place];
}

Finding check_dongle(const PluggedIn& plugged_in, const RadioAddress& radio, const SystemFiles& files) {
  const std::optional<UsbIdentity> dongle = named_dongle(plugged_in, radio);
  if (dongle) return {Mark::kOk, "dongle", dongle_text(*dongle), ""};
  if (!plugged_in.dongles.empty()) return no_such_dongle(plugged_in, radio);
  if (!plugged_in.boot_loaders.empty())
    return {
        Mark::kProblem, "dongle",
        "a Crazyradio PA that waits in its boot loader, " + place_of(plugged_in.boot_loaders.front()),
        "pull it out and plug it in again without touching its button; if it stays so, flash its firmware"};
  if (!files.exists("/sys/bus/usb"))
    return {Mark::kProblem, "dongle", std::string("no Crazyradio found") + kNoUsb, kHandThrough};
  return {Mark::kProblem, "dongle", "no Crazyradio is plugged in",
          "plug a Crazyradio PA or 2.0 into a USB port" +
              std::string(plugged_in.vehicles.empty() ? "" : ", or use the vehicle's cable: usb://0")};
}

Finding check_dongle_firmware(const UsbIdentity& dongle) {
  const std::uint16_t release = dongle.release_bcd;
  const std::string version = version_text(release);
  if (release < kOldestCrazyradioRelease)
    return {Mark::kProblem, "dongle firmware", version + " cannot do what swiftlet needs",
            "update the dongle to " + version_text(kNewestOfPa)};
  const bool is_old_pa = !is_radio2(dongle) && release < kNewestOfPa;
  const bool is_old_radio2 = is_radio2(dongle) && release >= kFirstOfRadio2 && release < kAdvisedOfRadio2;
  if (is_old_pa || is_old_radio2)
    return {Mark::kWarning, "dongle firmware", version + " is old",
            "update the dongle to " + version_text(is_old_pa ? kNewestOfPa : kAdvisedOfRadio2) + " or newer"};
  return {Mark::kOk, "dongle firmware", version, ""};
}

Finding check_cable(const PluggedIn& plugged_in, int index, const SystemFiles& files) {
  const std::optional<UsbIdentity> vehicle = named_vehicle(plugged_in, index);
  if (vehicle)
    return {Mark::kOk, "cable", description_of(*vehicle, vehicle->name.empty() ? "Crazyflie" : vehicle->name),
            ""};
  if (!plugged_in.vehicles.empty())
    return {Mark::kProblem, "cable",
            "no vehicle number " + std::to_string(index) + ", " + std::to_string(plugged_in.vehicles.size()) +
                " on cables",
            "write usb://0 for the first"};
  if (!files.exists("/sys/bus/usb"))
    return {Mark::kProblem, "cable", std::string("no Crazyflie found") + kNoUsb, kHandThrough};
  return {Mark::kProblem, "cable", "no Crazyflie is plugged in by its USB cable",
          "plug it in and switch it on; a cable for charging only will not do"};
}

Finding check_permission(const UsbIdentity& device, const SystemFiles& files) {
  const std::string node = device_node(device);
  if (device.access != UsbOutcome::kAccessDenied) return {Mark::kOk, "permission", "may open " + node, ""};
  if (!has_rule(files))
    return {Mark::kProblem, "permission", "may not open " + node + ": no udev rule for the Crazyradio",
            std::string(kInstallRule) + ", then plug the device in again"};
  return {
      Mark::kProblem, "permission", "may not open " + node + ", although there is a udev rule",
      "plug the device in again; if that does not help (remote login), sudo usermod -aG plugdev $USER and "
      "log in again"};
}

Finding check_in_use(UsbBus& bus, const UsbIdentity& device, const SystemFiles& files) {
  const auto opened = bus.open(device, 0);
  const UsbOutcome* refused = std::get_if<UsbOutcome>(&opened);
  if (refused == nullptr) return {Mark::kOk, "in use", "by no other program", ""};
  if (*refused == UsbOutcome::kBusy) {
    const std::optional<DeviceHolder> holder = find_holder(files, device_node(device));
    const std::string who =
        holder ? "process " + std::to_string(holder->pid) + " (" + holder->command + ')' : "another program";
    return {Mark::kProblem, "in use", "by " + who,
            "close it: a radio serves one program" +
                std::string(holder ? "" : "; sudo swiftlet doctor names programs of other users too")};
  }
  if (*refused == UsbOutcome::kNoDevice)
    return {Mark::kProblem, "in use", "it was unplugged just now", "plug it in again"};
  return {Mark::kProblem, "in use", "it does not open: it answers with errors",
          "plug it in again, into another port if need be; USB 2 ports and hubs give less trouble"};
}

Finding check_usb_power(const UsbIdentity& device, const SystemFiles& files) {
  const std::optional<std::string> path = sysfs_of(device, files);
  const std::optional<std::string> control = path ? files.read(*path + "/power/control") : std::nullopt;
  if (!control) return {Mark::kSkipped, "usb power", "the system does not report it", ""};
  if (*control == "on") return {Mark::kOk, "usb power", "the device is kept awake", ""};
  return {Mark::kWarning, "usb power", "the kernel may put the device to sleep while no program uses it",
          kInstallRule};
}

}  // namespace swiftlet
