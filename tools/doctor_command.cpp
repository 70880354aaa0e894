// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor_command.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/publish/lcm_url.hpp"
#include "daemon/recording/recording_files.hpp"
#include "daemon/system/terminal.hpp"
#include "firmware_link/file/input_file.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/libusb_bus.hpp"
#include "firmware_link/link/radio_scan.hpp"
#include "firmware_link/session/toc_cache.hpp"
#include "tools/doctor/examination.hpp"
#include "tools/doctor/network.hpp"
#include "tools/doctor/report.hpp"

namespace swiftlet {
namespace {

std::vector<RadioAddress> scan(UsbBus& bus, const RadioAddress& wanted) {
  auto scanned = scan_radio(bus, wanted);
  auto* found = std::get_if<std::vector<RadioAddress>>(&scanned);
  return found != nullptr ? std::move(*found) : std::vector<RadioAddress>();
}

}  // namespace

Result<bool> run_doctor_command(const DoctorCommand& command) {
  const Result<InputUri> uri = parse_input_uri(command.input);
  if (!uri) return uri.error();
  if (const auto* file = uri->as<InputFile>())
    if (const auto size = size_of_input_file(file->path); !size) return size.error();
  const Result<LcmUrl> lcm_url = parse_lcm_url(command.lcm_url);
  if (!lcm_url) return lcm_url.error();
  if (isatty(STDERR_FILENO) == 1) std::fputs("swiftlet: looking, this takes some seconds\n", stderr);

  SystemNetwork network;
  const Result<std::unique_ptr<UsbBus>> bus = LibusbBus::open();
  const Result<std::filesystem::path> recordings = default_recordings_directory();
  TocCache cache(TocCache::default_directory());
  const Surroundings around{
      .files = SystemFiles(),
      .network = network,
      .usb_bus = bus ? bus->get() : nullptr,
      .cache = cache,
      .recording_directory = recordings ? *recordings : std::filesystem::path(),
      .open_link = [](const InputUri& input) { return input.kind->open(input.address); },
      .scan = [&bus](const RadioAddress& radio) { return scan(**bus, radio); }};
  const Findings findings = examine(*uri, *lcm_url, around);
  const std::string report = command.json ? report_json(command.input, findings)
                                          : report_text(findings, wants_colours(STDOUT_FILENO));
  std::fputs(report.c_str(), stdout);
  return count(findings, Mark::kProblem) == 0;
}

}  // namespace swiftlet
