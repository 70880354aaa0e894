// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/result.hpp"
#include "daemon/publish/lcm_url.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/radio_address.hpp"
#include "firmware_link/link/usb_device.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "tools/doctor/finding.hpp"
#include "tools/doctor/network.hpp"
#include "tools/doctor/system_files.hpp"

namespace swiftlet {

/// What an examination looks at besides the vehicle. References must outlive it.
struct Surroundings {
  SystemFiles files;
  Network& network;
  UsbBus* usb_bus = nullptr;  ///< nullptr: this machine offers none
  TocCache& cache;
  std::filesystem::path recording_directory;
  std::function<Result<LinkInput>(const InputUri&)> open_link;
  /// Where else that address answers; asked where it does not on its own channel, the link closed.
  std::function<std::vector<RadioAddress>(const RadioAddress&)> scan;
};

/// All checks for an input, each once, in the order in which their problems are best solved. Takes up to half
/// a minute where the vehicle does not answer.
[[nodiscard]] Findings examine(const InputUri& uri, const LcmUrl& lcm_url, const Surroundings& around);

}  // namespace swiftlet
