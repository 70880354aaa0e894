// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/device_holder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/support/temporary_file.hpp"
#include "tests/tools/doctor/fake_system.hpp"
#include "tests/tools/doctor/fake_usb_bus.hpp"

namespace swiftlet {
namespace {

TEST(DeviceNode, HasThreeDigitsForBusAndDevice) {
  EXPECT_EQ(device_node(plugged_in_at(1, 42, 0x1915, 0x7777)), "/dev/bus/usb/001/042");
}

TEST(FindHolder, NamesTheProgramThatHasTheDeviceOpen) {
  const FakeSystem system;
  system.link("/proc/self", "50");
  system.write("/proc/12/comm", "bash\n");
  system.link("/proc/12/fd/0", "/dev/pts/0");
  system.write("/proc/4711/cmdline", std::string("python3\0-m\0cfclient\0", 20));
  system.link("/proc/4711/fd/0", "/dev/pts/1");
  system.link("/proc/4711/fd/17", "/dev/bus/usb/001/004");
  const auto holder = find_holder(system.files(), "/dev/bus/usb/001/004");
  ASSERT_TRUE(holder.has_value());
  EXPECT_EQ(holder->pid, 4711);
  EXPECT_EQ(holder->command, "python3 -m cfclient");
}

TEST(FindHolder, DoesNotNameItself) {
  const FakeSystem system;
  system.link("/proc/self", "50");
  system.link("/proc/50/fd/3", "/dev/bus/usb/001/004");
  EXPECT_FALSE(find_holder(system.files(), "/dev/bus/usb/001/004").has_value());
}

TEST(FindHolder, TakesTheShortNameOfAProgramWithoutArguments) {
  const FakeSystem system;
  system.write("/proc/7/cmdline", "");
  system.write("/proc/7/comm", "cfclient\n");
  system.link("/proc/7/fd/3", "/dev/bus/usb/001/004");
  const auto holder = find_holder(system.files(), "/dev/bus/usb/001/004");
  ASSERT_TRUE(holder.has_value());
  EXPECT_EQ(holder->command, "cfclient");
}

TEST(FindHolder, FindsARunningProgram) {
  const TemporaryFile file("node", "");
  const std::ifstream held(file.path());
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    pause();
    _exit(0);
  }
  const auto holder = find_holder(SystemFiles(), file.path());
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(holder.has_value());
  EXPECT_EQ(holder->pid, child);
}

}  // namespace
}  // namespace swiftlet
