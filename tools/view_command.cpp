// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/view_command.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

#include "daemon/system/signal_watcher.hpp"
#include "daemon/view/view_service.hpp"
#include "firmware_link/link/udp_address.hpp"
#include "firmware_link/link/uri_text.hpp"
#include "tools/command_end.hpp"
#include "tools/map_command.hpp"
#include "tools/prepared_run.hpp"
#include "tools/view/mapped_recording.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kStopWait{100};  // the longest a signal goes unnoticed

/// As a browser names the site of a page: SCHEME://HOST[:PORT], or file://.
bool is_origin(const std::string& text) {
  const std::size_t end = text.find("://");
  if (end == std::string::npos || end == 0 || !is_letter(text.front())) return false;
  const std::string scheme = text.substr(0, end);
  const auto may_stand_in_scheme = [](char c) {
    return is_digit(c) || is_letter(c) || c == '+' || c == '-' || c == '.';
  };
  if (!std::ranges::all_of(scheme, may_stand_in_scheme)) return false;
  const std::string host = text.substr(end + 3);
  return in_capitals(scheme) == "FILE" ? host.empty() : parse_udp_address(host).ok();
}

/// Another would be the origin of no page.
Status check_origins(const std::vector<std::string>& origins) {
  for (const std::string& origin : origins)
    if (!is_origin(origin))
      return Error{ErrorCode::kInvalidInput, "--allow-origin '" + origin +
                                                 "': must be SCHEME://HOST[:PORT], as in "
                                                 "https://app.foxglove.dev, or file://"};
  return {};
}

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

/// Pages may look at what there is until then.
void wait_for(const std::stop_token& stop) {
  while (!stop.stop_requested()) std::this_thread::sleep_for(kStopWait);
}

Status view_live(const ViewCommand& command, const std::stop_token& stop) {
  const Result<std::unique_ptr<ViewService>> service =
      open_service(command, {.title = command.lcm_url, .is_recording = false, .rate = 1.0});
  if (!service) return service.error();
  Status viewed = view_lcm(command.lcm_url, command.channel_prefix, (*service)->shared(), stop, {});
  if (viewed) wait_for(stop);
  return viewed;
}

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
  wait_for(stop);
  return damage;
}

}  // namespace

Status run_view_command(const ViewCommand& command) {
  if (Status usable = check_origins(command.foreign_origins); !usable) return usable;
  const SignalWatcher signals;
  const std::stop_token stop = signals.token();
  return command.input.empty() ? view_live(command, stop) : view_recording(command, stop);
}

}  // namespace swiftlet
