// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/usb_checks.hpp"

#include <gmock/gmock.h>

#include "tests/tools/doctor/fake_system.hpp"
#include "tests/tools/doctor/fake_usb_bus.hpp"

namespace swiftlet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

UsbIdentity boot_loader() { return plugged_in_at(1, 6, 0x1915, 0x0101); }
UsbIdentity vehicle_on_cable() {
  UsbIdentity vehicle = plugged_in_at(2, 3, 0x0483, 0x5740);
  vehicle.manufacturer = "Bitcraze AB";
  vehicle.name = "Crazyflie 2.1";
  return vehicle;
}
UsbIdentity crazyradio_2() {
  UsbIdentity dongle = crazyradio_pa();
  dongle.name = "Crazyradio 2.0";
  dongle.serial = "A1B2C3D4E5F60718";
  dongle.release_bcd = 0x0504;
  return dongle;
}

class UsbChecks : public testing::Test {
 protected:
  UsbChecks() { system_.write("/sys/bus/usb/drivers_autoprobe", "1\n"); }
  Finding dongle(const std::string& name = "0") {
    RadioAddress radio;
    radio.dongle = name;
    return check_dongle(look_at_bus(bus_), radio, system_.files());
  }
  Finding in_use() { return check_in_use(bus_, crazyradio_pa(), system_.files()); }

  FakeUsbBus bus_;
  FakeSystem system_;
};

TEST_F(UsbChecks, TheDongleIsNamedWithSerialNumberAndPlace) {
  bus_.devices = {crazyradio_pa()};
  const Finding finding = dongle();
  EXPECT_EQ(finding.mark, Mark::kOk);
  EXPECT_EQ(finding.found, "Crazyradio PA USB Dongle, serial 0123456789, bus 1 device 4");
}

TEST_F(UsbChecks, ADongleIsFoundByIndexBySerialNumberOrAnyhow) {
  bus_.devices = {crazyradio_pa(), crazyradio_2()};
  EXPECT_THAT(dongle("0").found, HasSubstr("Crazyradio PA"));
  EXPECT_THAT(dongle("1").found, HasSubstr("Crazyradio 2.0"));
  EXPECT_THAT(dongle("A1B2C3D4E5F60718").found, HasSubstr("Crazyradio 2.0"));
  EXPECT_THAT(dongle("a1b2c3d4e5f60718").found, HasSubstr("Crazyradio 2.0"));
  EXPECT_THAT(dongle("*").found, HasSubstr("Crazyradio PA"));
}

TEST_F(UsbChecks, AnUnknownDongleIsToldFromThoseThatAreThere) {
  bus_.devices = {crazyradio_pa()};
  for (const char* name : {"1", "A1B2C3D4E5F60718"}) {
    const Finding finding = dongle(name);
    EXPECT_EQ(finding.mark, Mark::kProblem);
    EXPECT_THAT(finding.found, AllOf(HasSubstr(name), HasSubstr("0123456789")));
  }
}

TEST_F(UsbChecks, ADongleWhoseSerialNumberIsHiddenMayBeTheOne) {
  UsbIdentity locked = crazyradio_pa();
  locked.serial = "";
  locked.access = UsbOutcome::kAccessDenied;
  bus_.devices = {locked};
  EXPECT_EQ(dongle("A1B2C3D4E5F60718").mark, Mark::kOk);
}

TEST_F(UsbChecks, NoDongleIsAProblemAndACableAWayOut) {
  EXPECT_EQ(dongle().mark, Mark::kProblem);
  EXPECT_THAT(dongle().remedy, Not(HasSubstr("usb://0")));
  bus_.devices = {vehicle_on_cable()};
  EXPECT_THAT(dongle().remedy, HasSubstr("usb://0"));
}

TEST_F(UsbChecks, ABootLoaderIsTold) {
  bus_.devices = {boot_loader()};
  EXPECT_THAT(dongle().found, HasSubstr("boot loader"));
  EXPECT_THAT(dongle().remedy, HasSubstr("without touching its button"));
}

TEST_F(UsbChecks, ASystemWithoutUsbIsTold) {
  const FakeSystem no_usb;
  EXPECT_THAT(check_dongle({}, {}, no_usb.files()).remedy, HasSubstr("virtual machine"));
}

TEST_F(UsbChecks, FirmwareIsReadAsItsMakersWriteIt) {
  EXPECT_EQ(check_dongle_firmware(crazyradio_pa()).found, "0.53");
  EXPECT_EQ(check_dongle_firmware(crazyradio_2()).found, "5.4");
  UsbIdentity self_built = crazyradio_pa();
  self_built.release_bcd = 0x9955;
  EXPECT_EQ(check_dongle_firmware(self_built).mark, Mark::kOk);
}

TEST_F(UsbChecks, OldFirmwareIsAWarningAndVeryOldAProblem) {
  UsbIdentity dongle = crazyradio_pa();
  dongle.release_bcd = 0x0052;
  EXPECT_EQ(check_dongle_firmware(dongle).mark, Mark::kWarning);
  EXPECT_THAT(check_dongle_firmware(dongle).remedy, HasSubstr("0.53"));
  dongle.release_bcd = 0x0030;
  EXPECT_EQ(check_dongle_firmware(dongle).mark, Mark::kProblem);
  dongle = crazyradio_2();
  dongle.release_bcd = 0x0500;
  EXPECT_EQ(check_dongle_firmware(dongle).mark, Mark::kWarning);
  EXPECT_THAT(check_dongle_firmware(dongle).remedy, HasSubstr("5.4"));
}

TEST_F(UsbChecks, OtherDevicesWithTheVehiclesNumbersAreNoVehicles) {
  UsbIdentity other = vehicle_on_cable();
  other.manufacturer = "STMicroelectronics";
  bus_.devices = {other, vehicle_on_cable()};
  EXPECT_THAT(look_at_bus(bus_).vehicles, SizeIs(1));
}

TEST_F(UsbChecks, TheCableNamesTheVehicle) {
  bus_.devices = {vehicle_on_cable()};
  const PluggedIn plugged_in = look_at_bus(bus_);
  EXPECT_THAT(check_cable(plugged_in, 0, system_.files()).found, HasSubstr("Crazyflie 2.1"));
  EXPECT_THAT(check_cable(plugged_in, 1, system_.files()).found, HasSubstr("no vehicle number 1"));
  EXPECT_THAT(check_cable({}, 0, system_.files()).remedy, HasSubstr("for charging only"));
}

TEST_F(UsbChecks, WithoutPermissionTheRemedyDependsOnTheRule) {
  UsbIdentity locked = crazyradio_pa();
  locked.access = UsbOutcome::kAccessDenied;
  EXPECT_EQ(check_permission(crazyradio_pa(), system_.files()).mark, Mark::kOk);
  const Finding without = check_permission(locked, system_.files());
  EXPECT_EQ(without.mark, Mark::kProblem);
  EXPECT_THAT(without.found, HasSubstr("/dev/bus/usb/001/004"));
  EXPECT_THAT(without.remedy, HasSubstr("tools/install-udev-rule"));
  system_.write("/etc/udev/rules.d/99-bitcraze.rules",
                "SUBSYSTEM==\"usb\", ATTRS{idVendor}==\"1915\", ATTRS{idProduct}==\"7777\", MODE=\"0664\"\n");
  EXPECT_THAT(check_permission(locked, system_.files()).remedy, HasSubstr("plugdev"));
}

TEST_F(UsbChecks, ABusyDongleNamesTheProgram) {
  EXPECT_EQ(in_use().mark, Mark::kOk);
  bus_.opening = UsbOutcome::kBusy;
  EXPECT_THAT(in_use().found, HasSubstr("another program"));
  EXPECT_THAT(in_use().remedy, HasSubstr("sudo swiftlet doctor"));
  system_.write("/proc/4711/comm", "cfclient\n");
  system_.link("/proc/4711/fd/9", "/dev/bus/usb/001/004");
  EXPECT_EQ(in_use().mark, Mark::kProblem);
  EXPECT_EQ(in_use().found, "by process 4711 (cfclient)");
}

TEST_F(UsbChecks, ADongleThatDoesNotOpenIsAProblemOfItsOwnKind) {
  bus_.opening = UsbOutcome::kNoDevice;
  EXPECT_THAT(in_use().found, HasSubstr("unplugged"));
  bus_.opening = UsbOutcome::kFault;
  EXPECT_THAT(in_use().found, HasSubstr("errors"));
}

TEST_F(UsbChecks, SleepIsReadFromTheDevicesOwnDirectory) {
  const auto power = [this] { return check_usb_power(crazyradio_pa(), system_.files()); };
  EXPECT_EQ(power().mark, Mark::kSkipped);
  system_.write("/sys/bus/usb/devices/1-1/busnum", "1\n");
  system_.write("/sys/bus/usb/devices/1-1/devnum", "3\n");
  system_.write("/sys/bus/usb/devices/1-1/power/control", "auto\n");
  system_.write("/sys/bus/usb/devices/1-2/busnum", "1\n");
  system_.write("/sys/bus/usb/devices/1-2/devnum", "4\n");
  system_.write("/sys/bus/usb/devices/1-2/power/control", "on\n");
  EXPECT_EQ(power().mark, Mark::kOk);
  system_.write("/sys/bus/usb/devices/1-2/power/control", "auto\n");
  EXPECT_EQ(power().mark, Mark::kWarning);
}

}  // namespace
}  // namespace swiftlet
