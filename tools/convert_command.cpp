// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/convert_command.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>
#include <system_error>
#include <utility>

#include "daemon/outputs/file_writer.hpp"
#include "daemon/outputs/g2o_graph.hpp"
#include "daemon/system/signal_watcher.hpp"
#include "daemon/view/view_service.hpp"
#include "firmware_link/input/input_uri.hpp"
#include "firmware_link/sample_table/sample_table.hpp"
#include "tools/command_end.hpp"
#include "tools/convert/mcap_run.hpp"
#include "tools/map_command.hpp"
#include "tools/mapped_run.hpp"
#include "tools/prepared_run.hpp"
#include "tools/progress_bar.hpp"
#include "tools/view/mapped_recording.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

MapCommand mapping_of(const ConvertCommand& command) {
  MapCommand mapping;
  mapping.input = command.input;
  mapping.config_file = command.config_file;
  mapping.beams = command.beams;
  mapping.calibrate = command.calibrate;
  return mapping;
}

Status no_sample_of(const ConvertCommand& command, const InputReport& report) {
  const std::string reason =
      report.problems.empty() ? "it ended before the first one" : report.problems.front();
  return Error{ErrorCode::kInvalidInput, command.input + " holds no usable sample: " + reason};
}

/// The samples as received: not mended, no age estimated.
Status convert_to_csv(const ConvertCommand& command, const std::stop_token& stop) {
  MapCommand reading = mapping_of(command);
  reading.odometry_only = true;
  const Result<PreparedRun> run = prepare_run(reading, stop);
  if (!run) return run.error();
  SampleSource& source = *run->source;
  std::size_t samples = 0;
  StoreyId storey{};
  Status written = write_file(command.output, [&](const FileSink& write) -> Status {
    Result<ReceivedSample> next = source.next();
    std::string text = sample_table_head({.beams = source.beams(), .sensor = source.sensor()});
    bool goes_on = !stop.stop_requested();
    for (; goes_on && (next || next.error().code == ErrorCode::kTimeout); next = source.next()) {
      if (!next) continue;
      append_sample_row(text, next->sample, storey);
      goes_on = write(text) && !stop.stop_requested();
      text.clear();
      ++samples;
    }
    if (stop.stop_requested()) return stopped_error(command.input);
    return samples > 0 ? Status() : no_sample_of(command, source.report());
  });
  if (!written) return written;
  std::printf("%zu samples: %s\n", samples, command.output.c_str());
  return damage_of(source.report());
}

fs::path folder_of(const std::string& output) {
  std::error_code failure;
  return fs::absolute(output, failure).parent_path();
}

Status convert_to_g2o(const ConvertCommand& command, const std::stop_token& stop) {
  const MapCommand mapping = mapping_of(command);
  Result<PreparedRun> prepared = prepare_run(mapping, stop);
  if (!prepared) return prepared.error();
  const Result<std::unique_ptr<MappedRun>> run =
      map_with_progress_bar(mapping, std::move(prepared).value(), folder_of(command.output), stop);
  if (!run) return run.error();
  const Backend& backend = (*run)->backend();
  const PoseGraph& graph = backend.pose_graph();
  if (Status written = write_file(command.output, g2o_text(graph)); !written) return written;
  std::printf("%zu keyframes, %zu closures: %s\n", graph.T_map_keyframe.size(), backend.closures().size(),
              command.output.c_str());
  return damage_of((*run)->report());
}

void print_messages(const ConvertCommand& command, std::uint64_t messages) {
  std::printf("%llu messages: %s\n", static_cast<unsigned long long>(messages), command.output.c_str());
}

/// Asks for a stop once the disk takes no more.
FileSink sink_that_stops(const FileSink& write, std::stop_source& over) {
  return [&](std::string_view bytes) {
    const bool goes_on = write(bytes);
    if (!goes_on) over.request_stop();
    return goes_on;
  };
}

/// Maps the recording into an MCAP file; `report` is of the input.
Status write_mcap(const ConvertCommand& command, const std::stop_token& stop, const FileSink& write,
                  InputReport& report, std::uint64_t& messages) {
  const MapCommand mapping = mapping_of(command);
  Result<PreparedRun> run = prepare_run(mapping, stop);
  if (!run) return run.error();
  Result<PrunedScans> pruned = PrunedScans::open(folder_of(command.output));
  if (!pruned) return pruned.error();
  SharedRunHistory shared;
  std::stop_source over;
  const std::stop_callback at_stop(stop, [&over] { over.request_stop(); });
  McapRun mcap(sink_that_stops(write, over));
  bool is_complete = false;
  ProgressBar bar(stderr, ProgressBar::Clock::now());
  const auto after_sample = [&] {
    mcap.add_news(shared.history);
    bar.update(run->source->progress(), ProgressBar::Clock::now());
  };
  const auto at_end = [&](const Backend& backend) -> Status {
    report = run->source->report();
    if (Status usable = check_usable(mapping, report, backend); !usable) return usable;
    mcap.add_last(shared.history);
    if (Status added = mcap.add_trajectory(backend, &*pruned); !added) return added;
    mcap.finish();
    messages = mcap.messages();
    is_complete = true;
    return {};
  };
  Status mapped = map_recording(*run, shared, over.get_token(),
                                {.after_sample = after_sample, .at_end = at_end, .pruned = &*pruned});
  if (stop.stop_requested()) return stopped_error(command.input);
  if (!mapped && !is_complete) return mapped;
  if (!mapped && report.problems.empty()) report.problems.push_back(mapped.error().message);
  return {};
}

Status convert_to_mcap(const ConvertCommand& command, const std::stop_token& stop) {
  InputReport report;
  std::uint64_t messages = 0;
  Status written = write_file(command.output, [&](const FileSink& write) {
    return write_mcap(command, stop, write, report, messages);
  });
  if (!written) return written;
  print_messages(command, messages);
  return damage_of(report);
}

/// What a running swiftletd publishes, until a stop is requested.
Status record_mcap(const ConvertCommand& command, const std::stop_token& stop) {
  std::stop_source over;
  const std::stop_callback at_stop(stop, [&over] { over.request_stop(); });
  std::printf("listening on %s; Ctrl-C ends\n", command.lcm_url.c_str());
  std::fflush(stdout);
  std::uint64_t messages = 0;
  Status written = record_file(command.output, [&](const FileSink& write) -> Status {
    SharedRunHistory shared;
    McapRun mcap(sink_that_stops(write, over));
    const auto after_message = [&] {
      mcap.add_news(shared.history);
      if (shared.history.is_finished_at(std::nullopt)) over.request_stop();
    };
    Status listened =
        view_lcm(command.lcm_url, command.channel_prefix, shared, over.get_token(), after_message);
    if (!listened) return listened;
    mcap.add_last(shared.history);
    if (mcap.messages() == 0)
      return Error{ErrorCode::kInvalidInput,
                   "no pose was received on " + command.lcm_url + "; swiftlet doctor checks LCM"};
    mcap.finish();
    messages = mcap.messages();
    return {};
  });
  if (written) print_messages(command, messages);
  return written;
}

struct OutputKind {
  std::string_view ending;
  Status (*convert)(const ConvertCommand& command, const std::stop_token& stop);
  /// A running swiftletd; nullptr: cannot be.
  Status (*record)(const ConvertCommand& command, const std::stop_token& stop);
};
constexpr std::array kOutputKinds{OutputKind{".csv", convert_to_csv, nullptr},
                                  OutputKind{".g2o", convert_to_g2o, nullptr},
                                  OutputKind{".mcap", convert_to_mcap, record_mcap}};

const OutputKind* kind_of(const std::string& output) {
  for (const OutputKind& kind : kOutputKinds)
    if (output.ends_with(kind.ending)) return &kind;
  return nullptr;
}

Error cannot_write(const ConvertCommand& command, const std::string& reason) {
  return {ErrorCode::kInvalidInput, command.output + ": " + reason};
}

/// Asked before the work.
Status check_output(const ConvertCommand& command) {
  if (kind_of(command.output) == nullptr)
    return cannot_write(command, "the output's name must end with .csv, .g2o or .mcap");
  if (command.input == kLcmInput && kind_of(command.output)->record == nullptr)
    return cannot_write(command, "a running swiftletd gives an .mcap file only");
  return check_output_file(command.output, std::array{fs::path(file_of_input(command.input))});
}

}  // namespace

Status run_convert_command(const ConvertCommand& command) {
  if (Status usable = check_output(command); !usable) return usable;
  spdlog::set_level(spdlog::level::off);  // what happens in the run goes into the file
  std::error_code failure;
  const bool replaces = fs::exists(command.output, failure);
  const OutputKind& kind = *kind_of(command.output);
  const SignalWatcher signals;
  const bool records = command.input == kLcmInput;
  Status converted = (records ? kind.record : kind.convert)(command, signals.token());
  if (!converted && !records && converted.error().code == ErrorCode::kTimeout)
    return Error{ErrorCode::kTimeout, "conversion stopped before its end; nothing was written"};
  const bool was_written = converted || converted.error().code == ErrorCode::kDamaged;
  if (replaces && was_written)
    std::fprintf(stderr, "swiftlet: note: %s was there and has been replaced\n", command.output.c_str());
  return converted;
}

}  // namespace swiftlet
