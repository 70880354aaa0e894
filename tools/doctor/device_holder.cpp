// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/device_holder.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace swiftlet {
namespace {

std::optional<int> as_pid(const std::string& name) {
  int pid = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, pid);
  return error == std::errc{} && stop == end ? std::optional(pid) : std::nullopt;
}

bool holds(const SystemFiles& files, const std::string& process, const std::string& node) {
  const std::vector<std::string> descriptors = files.names_in(process + "/fd");
  return std::any_of(descriptors.begin(), descriptors.end(), [&](const std::string& descriptor) {
    return files.target_of(process + "/fd/" + descriptor) == node;
  });
}

std::string command_of(const SystemFiles& files, const std::string& process) {
  std::string command = files.read(process + "/cmdline").value_or("");
  while (!command.empty() && command.back() == '\0') command.pop_back();
  std::replace(command.begin(), command.end(), '\0', ' ');
  return command.empty() ? files.read(process + "/comm").value_or("?") : command;
}

}  // namespace

std::string device_node(const UsbIdentity& device) {
  char node[32];
  std::snprintf(node, sizeof node, "/dev/bus/usb/%03u/%03u", unsigned{device.bus}, unsigned{device.address});
  return node;
}

std::optional<DeviceHolder> find_holder(const SystemFiles& files, const std::string& node) {
  const std::optional<std::string> self = files.target_of("/proc/self");
  for (const std::string& name : files.names_in("/proc")) {
    const std::optional<int> pid = as_pid(name);
    const std::string process = "/proc/" + name;
    if (pid && name != self && holds(files, process, node))
      return DeviceHolder{*pid, command_of(files, process)};
  }
  return std::nullopt;
}

}  // namespace swiftlet
