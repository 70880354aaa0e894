// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/view_command.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "daemon/system/signal_watcher.hpp"
#include "daemon/view/view_service.hpp"
#include "tools/map_command.hpp"
#include "tools/prepared_run.hpp"
#include "tools/view/mapped_recording.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kStopWait{100};  // the longest a signal goes unnoticed

Result<std::unique_ptr<ViewService>> open_service(const ViewCommand& command, const ShownSource& source) {
  const Result<ListenAddress> address = parse_listen_address(command.listen);
  if (!address) return address.error();
  Result<std::unique_ptr<ViewService>> service = ViewService::open(*address, source, command.foreign_origins);
  if (!service) return service;
  std::printf("%s: open %s in a browser; Ctrl-C ends\n", source.title.c_str(),
              (*service)->server().url().c_str());
  std::fflush(stdout);
  if ((*service)->server().is_beyond_this_machine())
    std::fprintf(stderr, "swiftlet: note: whoever reaches %s sees the map\n",
                 (*service)->server().url().c_str());
  return service;
}

Status view_live(const ViewCommand& command, const std::stop_token& stop) {
  const Result<std::unique_ptr<ViewService>> service =
      open_service(command, {.title = command.lcm_url, .is_recording = false, .rate = 1.0});
  if (!service) return service.error();
  return view_lcm(command.lcm_url, command.channel_prefix, (*service)->shared(), stop, {});
}

void print_note(const std::string& note) { std::fprintf(stderr, "swiftlet: note: %s\n", note.c_str()); }

/// Damage is told when it is known, and once more as the reason of the exit code.
Status view_recording(const ViewCommand& command, const std::stop_token& stop) {
  MapCommand mapping;
  mapping.input = command.input;
  mapping.config_file = command.config_file;
  mapping.beams = command.beams;
  mapping.calibrate = false;  // what would read the whole input before the first picture
  Result<PreparedRun> run = prepare_run(mapping);
  if (!run) return run.error();
  const Result<std::unique_ptr<ViewService>> service =
      open_service(command, {.title = command.input, .is_recording = true, .rate = command.rate});
  if (!service) return service.error();
  spdlog::set_level(spdlog::level::err);  // the page tells what happens in the run
  const Status mapped = map_recording(*run, (*service)->shared(), stop, {});
  Status damage = damage_of(run->source->report());
  if (damage && !mapped) damage = mapped.error();
  for (const std::string& note : run->source->report().notes) print_note(note);
  if (!damage) print_note(damage.error().message);
  while (!stop.stop_requested()) std::this_thread::sleep_for(kStopWait);
  return damage;
}

}  // namespace

Status run_view_command(const ViewCommand& command) {
  const SignalWatcher signals;
  const std::stop_token stop = signals.token();
  return command.input.empty() ? view_live(command, stop) : view_recording(command, stop);
}

}  // namespace swiftlet
