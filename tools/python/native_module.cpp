// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// What of the Python package swiftlet is C++: swiftlet/_native.pyi has its types, the package its documents.
// Values are handed over as dicts and arrays, of which the package makes its classes. No thread but the
// caller's touches Python.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/sensing/range_sample.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/version.hpp"
#include "tools/python/mapping_thread.hpp"
#include "tools/python/message_listener.hpp"
#include "tools/python/run_arrays.hpp"

namespace py = pybind11;

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kSignalPeriod{100};  // the longest Ctrl-C goes unnoticed

/// Becomes Python's swiftlet.Error.
class PythonError final : public std::runtime_error {
 public:
  explicit PythonError(const Error& error) : std::runtime_error(error.message) {}
};

/// Python's handlers of signals run on its main thread alone; elsewhere this does nothing.
void check_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Names of files and what is quoted of a damaged one need not be UTF-8: other bytes become U+FFFD.
py::str text_of(const std::string& bytes) {
  const auto size = static_cast<py::ssize_t>(bytes.size());
  PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), size, "replace");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

py::list texts_of(const std::vector<std::string>& lines) {
  py::list out;
  for (const std::string& line : lines) out.append(text_of(line));
  return out;
}

/// An array that takes the numbers over.
template <typename Number>
py::array_t<Number> array_of(std::vector<Number> numbers, const std::vector<py::ssize_t>& shape) {
  auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
  const py::capsule owner(kept.get(), [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
  return py::array_t<Number>(shape, kept.release()->data(), owner);  // the capsule's from here on
}

py::array_t<double> rows_of(std::vector<double> numbers, std::size_t columns) {
  const auto rows = static_cast<py::ssize_t>(numbers.size() / columns);
  return array_of(std::move(numbers), {rows, static_cast<py::ssize_t>(columns)});
}

py::array_t<std::int8_t> column_of(std::vector<std::int8_t> numbers) {
  const auto rows = static_cast<py::ssize_t>(numbers.size());
  return array_of(std::move(numbers), {rows});
}

py::array_t<double> matrices_of(std::vector<double> numbers) {
  constexpr auto kSide = static_cast<py::ssize_t>(kCovarianceSide);
  const auto count = static_cast<py::ssize_t>(numbers.size()) / (kSide * kSide);
  return array_of(std::move(numbers), {count, kSide, kSide});
}

py::dict grid_of(OccupancyGrid grid) {
  py::dict out;
  out["occupancy_percent"] =
      array_of(std::move(grid.occupancy_percent),
               {static_cast<py::ssize_t>(grid.rows), static_cast<py::ssize_t>(grid.columns)});
  out["resolution_m"] = grid.resolution_m;
  out["origin_m"] = py::make_tuple(grid.origin_map.x_m, grid.origin_map.y_m);
  return out;
}

py::dict dict_of(MappedInput run) {
  py::dict out;
  RunArrays& arrays = run.arrays;
  out["trajectory"] = rows_of(std::move(arrays.trajectory), kPoseColumns);
  out["live"] = rows_of(std::move(arrays.live), kPoseColumns);
  out["odometry"] = rows_of(std::move(arrays.odometry), kPoseColumns);
  out["truth"] = rows_of(std::move(arrays.truth), kPoseColumns);
  out["covariances"] = matrices_of(std::move(arrays.covariances));
  out["covariances_map"] = matrices_of(std::move(arrays.covariances_map));
  out["trajectory_storeys"] = column_of(std::move(arrays.storeys));
  out["walls"] = rows_of(std::move(arrays.walls.rows), kSegmentColumns);
  out["wall_storeys"] = column_of(std::move(arrays.walls.storeys));
  out["closures"] = rows_of(std::move(arrays.closures.rows), kSegmentColumns);
  out["closure_storeys"] = column_of(std::move(arrays.closures.storeys));
  out["dropped_closures"] = rows_of(std::move(arrays.dropped_closures.rows), kSegmentColumns);
  out["dropped_closure_storeys"] = column_of(std::move(arrays.dropped_closures.storeys));
  py::dict grids;
  for (auto& [storey, grid] : arrays.grids) grids[py::int_(index_of(storey))] = grid_of(std::move(grid));
  out["grids"] = grids;
  out["report"] = text_of(run.report_json);
  out["notes"] = texts_of(run.notes);
  out["problems"] = texts_of(run.problems);
  return out;
}

/// Maps on another thread, while this one sees to signals and progress.
py::dict map_input(MapCommand command, const py::object& on_progress) {
  if (command.beams && (*command.beams < 2 || *command.beams > static_cast<int>(kMaxBeams)))
    throw PythonError({ErrorCode::kInvalidInput, "beams = " + std::to_string(*command.beams) +
                                                     ": must lie between 2 and " +
                                                     std::to_string(kMaxBeams)});
  MappingThread mapping(std::move(command));
  try {
    for (bool is_done = false; !is_done;) {
      {
        const py::gil_scoped_release others_may_run;
        is_done = mapping.wait(kSignalPeriod);
      }
      check_signals();
      if (!on_progress.is_none() && (is_done || mapping.progress()))
        on_progress(is_done ? 1.0 : *mapping.progress());
    }
  } catch (...) {
    const py::gil_scoped_release others_may_run;
    mapping.stop();
    throw;
  }
  Result<MappedInput> mapped = mapping.take_result();
  if (!mapped) throw PythonError(mapped.error());
  return dict_of(std::move(mapped).value());
}

double seconds(std::int64_t utime_us) { return static_cast<double>(utime_us) * 1e-6; }

/// The name of a code of a message's type; a newer daemon may have codes of which this knows nothing.
const char* name_of_code(std::span<const char* const> names, std::int8_t code) {
  if (code < 0) return "unknown";
  const std::size_t index = static_cast<std::uint8_t>(code);
  return index < names.size() ? names[index] : "unknown";
}
constexpr std::array kFrames{"map", "local", "odom"};
constexpr std::array kTrackingStates{"good", "uncertain", "lost", "relocalizing"};
constexpr std::array kRunStates{"running", "finishing", "finished"};
constexpr std::array kRecordingStates{"none", "running", "failed"};
constexpr std::array kConditions{"none",          "connected",    "silent",         "device_missing",
                                 "access_denied", "device_busy",  "device_stalls",  "device_overflows",
                                 "device_mute",   "device_fault", "device_unsuited"};

/// nullopt for what a message has no value for.
std::optional<double> unless_negative(double value) {
  return value < 0.0 ? std::nullopt : std::optional(value);
}
std::optional<bool> tristate(std::int8_t value) {
  return value < 0 ? std::nullopt : std::optional(value != 0);
}

py::array_t<double> covariance_of(const double (&P)[6]) {
  return array_of<double>({P[0], P[1], P[2], P[1], P[3], P[4], P[2], P[4], P[5]}, {3, 3});
}

py::dict fields_of(const pose_t& message) {
  using py::literals::operator""_a;
  return py::dict("time_s"_a = seconds(message.utime), "map_id"_a = message.map_id,
                  "sequence"_a = message.sequence, "segment"_a = message.segment,
                  "keyframe"_a = message.keyframe, "correction_version"_a = message.correction_version,
                  "correction_m"_a = message.correction, "frame"_a = name_of_code(kFrames, message.frame),
                  "x_m"_a = message.x, "y_m"_a = message.y, "yaw_rad"_a = message.yaw,
                  "storey"_a = message.storey, "tracking"_a = name_of_code(kTrackingStates, message.tracking),
                  "covariance_map"_a = covariance_of(message.covariance_map),
                  "covariance_start"_a = covariance_of(message.covariance_start));
}

/// An array of double, as numpy's functions want it.
py::array_t<double> doubles_of(const std::vector<float>& numbers) {
  return array_of(std::vector<double>(numbers.begin(), numbers.end()),
                  {static_cast<py::ssize_t>(numbers.size())});
}

py::dict fields_of(const ranges_t& message) {
  using py::literals::operator""_a;
  const auto count = static_cast<py::ssize_t>(message.status.size());
  return py::dict(
      "time_s"_a = seconds(message.utime), "map_id"_a = message.map_id, "sequence"_a = message.sequence,
      "device_time_s"_a = seconds(message.device_utime),
      "max_range_m"_a = static_cast<double>(message.max_range), "bearing_rad"_a = doubles_of(message.bearing),
      "distance_m"_a = doubles_of(message.distance), "status"_a = array_of(message.status, {count}));
}

py::dict fields_of(const map_tile_t& message) {
  using py::literals::operator""_a;
  const std::int8_t* const cells = &message.occupancy_percent[0][0];
  std::vector<std::int8_t> percent(cells, cells + sizeof(message.occupancy_percent));
  constexpr py::ssize_t kSide = std::extent_v<decltype(message.occupancy_percent)>;
  return py::dict("time_s"_a = seconds(message.utime), "map_id"_a = message.map_id,
                  "tile_x"_a = message.tile_x, "tile_y"_a = message.tile_y, "storey"_a = message.storey,
                  "version"_a = message.version, "resolution_m"_a = message.resolution,
                  "occupancy_percent"_a = array_of(std::move(percent), {kSide, kSide}));
}

py::dict fields_of(const WallsMessage& message) {
  using py::literals::operator""_a;
  std::vector<std::int32_t> ids;
  std::vector<std::int8_t> storeys;
  std::vector<double> segments;
  for (const landmark_t& wall : message.walls) {
    ids.push_back(wall.id);
    storeys.push_back(wall.storey);
    for (const float coordinate : {wall.start[0], wall.start[1], wall.end[0], wall.end[1]})
      segments.push_back(static_cast<double>(coordinate));
  }
  const auto count = static_cast<py::ssize_t>(ids.size());
  return py::dict("time_s"_a = seconds(message.utime), "map_id"_a = message.map_id,
                  "ids"_a = array_of(std::move(ids), {count}),
                  "storeys"_a = array_of(std::move(storeys), {count}),
                  "segments_m"_a = rows_of(std::move(segments), kSegmentColumns));
}

py::dict fields_of(const loop_closure_t& message) {
  using py::literals::operator""_a;
  const auto point = [](const double(&p)[2]) { return py::make_tuple(p[0], p[1]); };
  return py::dict(
      "time_s"_a = seconds(message.utime), "map_id"_a = message.map_id, "index"_a = message.index,
      "from_keyframe"_a = message.from_keyframe, "to_keyframe"_a = message.to_keyframe, "x_m"_a = message.x,
      "y_m"_a = message.y, "yaw_rad"_a = message.yaw, "sigma_x_m"_a = message.sigma_x,
      "sigma_y_m"_a = message.sigma_y, "sigma_yaw_rad"_a = message.sigma_yaw, "score"_a = message.score,
      "dcs_scale"_a = message.dcs_scale, "dropped"_a = message.dropped != 0, "storey"_a = message.storey,
      "from_m"_a = point(message.from_map), "to_m"_a = point(message.to_map));
}

py::dict fields_of(const vehicle_event_t& message) {
  using py::literals::operator""_a;
  return py::dict("time_s"_a = seconds(message.utime), "map_id"_a = message.map_id, "text"_a = message.text);
}

py::dict fields_of(const link_status_t& link) {
  using py::literals::operator""_a;
  return py::dict(
      "condition"_a = name_of_code(kConditions, link.condition), "safelink"_a = link.safelink != 0,
      "ack_rate"_a = unless_negative(link.ack_rate), "retries_per_packet"_a = link.retries_per_packet,
      "sent_hz"_a = link.sent_rate, "received_hz"_a = link.received_rate,
      "round_trip_ms"_a = unless_negative(link.round_trip_ms),
      "rssi_dbm"_a = link.rssi_dbm == 0 ? std::nullopt : std::optional(link.rssi_dbm),
      "battery_v"_a = link.battery_v == 0.0 ? std::nullopt : std::optional(link.battery_v),
      "flying"_a = tristate(link.flying), "packets_sent"_a = link.packets_sent,
      "packets_acked"_a = link.packets_acked, "packets_received"_a = link.packets_received,
      "duplicates"_a = link.duplicates, "silences"_a = link.silences, "device_losses"_a = link.device_losses,
      "usb_timeouts"_a = link.usb_timeouts, "client"_a = tristate(link.client),
      "client_setpoints_dropped"_a = link.client_setpoints_dropped,
      "client_requests_dropped"_a = link.client_requests_dropped);
}

py::dict fields_of(const tracking_t& tracking) {
  using py::literals::operator""_a;
  return py::dict(
      "state"_a = name_of_code(kTrackingStates, tracking.state), "contradiction"_a = tracking.contradiction,
      "contradicting_share"_a = tracking.contradicting_share,
      "returns_compared"_a = tracking.returns_compared, "times_uncertain"_a = tracking.times_uncertain,
      "places_weighed"_a = tracking.places_weighed, "place_lead"_a = tracking.place_lead,
      "innovation"_a = tracking.innovation, "way_since_agreement_m"_a = tracking.way_since_agreement,
      "way_since_closure_m"_a = tracking.way_since_closure, "way_unplaced_m"_a = tracking.way_unplaced);
}

py::list queues_of(const status_t& message) {
  using py::literals::operator""_a;
  py::list out;
  for (const queue_status_t& queue : message.queues)
    out.append(py::dict("name"_a = text_of(queue.name), "capacity"_a = queue.capacity,
                        "high_water"_a = queue.high_water, "refused"_a = queue.refused));
  return out;
}

py::list stages_of(const status_t& message) {
  using py::literals::operator""_a;
  py::list out;
  for (const stage_time_t& stage : message.stages)
    out.append(py::dict("name"_a = text_of(stage.name), "count"_a = stage.count, "mean_ms"_a = stage.mean,
                        "p50_ms"_a = stage.p50, "p99_ms"_a = stage.p99, "p999_ms"_a = stage.p999,
                        "max_ms"_a = stage.max));
  return out;
}

py::dict fields_of(const status_t& message) {
  using py::literals::operator""_a;
  return py::dict("time_s"_a = seconds(message.utime), "map_id"_a = message.map_id,
                  "state"_a = name_of_code(kRunStates, message.state),
                  "progress"_a = unless_negative(message.progress), "sample_rate_hz"_a = message.sample_rate,
                  "frames"_a = message.frames, "samples"_a = message.samples, "gaps"_a = message.gaps,
                  "missing_packets"_a = message.missing_packets, "duplicates"_a = message.duplicates,
                  "out_of_order"_a = message.out_of_order, "unpaired"_a = message.unpaired,
                  "segments"_a = message.segments, "input_problems"_a = message.input_problems,
                  "link"_a = fields_of(message.link), "tracking"_a = fields_of(message.tracking),
                  "keyframes"_a = message.keyframes, "batches_rolled_back"_a = message.batches_rolled_back,
                  "submaps"_a = message.submaps, "closures_accepted"_a = message.closures_accepted,
                  "closures_dropped"_a = message.closures_dropped, "optimizations"_a = message.optimizations,
                  "solver_failures"_a = message.solver_failures, "tile_count"_a = message.tile_count,
                  "version_sum"_a = message.version_sum, "queues"_a = queues_of(message),
                  "stages"_a = stages_of(message), "missed_deadlines"_a = message.missed_deadlines,
                  "recording"_a = name_of_code(kRecordingStates, message.recording),
                  "recorded_bytes"_a = message.recorded_bytes);
}

/// In the order of DaemonMessage.
constexpr std::array kKinds{"pose", "ranges", "tile", "walls", "closure", "event", "status"};
static_assert(kKinds.size() == std::variant_size_v<DaemonMessage>);

/// Python's view of a MessageListener.
class PythonListener {
 public:
  PythonListener(const std::string& url, const std::string& channel_prefix,
                 const std::vector<std::string>& channels) {
    Result<std::unique_ptr<MessageListener>> opened = MessageListener::open(url, channel_prefix, channels);
    if (!opened) throw PythonError(opened.error());
    listener_ = std::move(opened).value();
  }

  /// (kind, fields) of the next message; None after `timeout_s` without one, or when has_ended().
  py::object receive(std::optional<double> timeout_s) {
    const std::unique_lock alone(mutex_, std::try_to_lock);
    if (!alone)
      throw PythonError(
          {ErrorCode::kInvalidInput, "another thread waits for this listener's messages; give each its own"});
    using SteadyTime = std::chrono::steady_clock;
    const auto began = SteadyTime::now();
    for (;;) {
      const double waited_s = std::chrono::duration<double>(SteadyTime::now() - began).count();
      const double left_s = timeout_s ? std::max(*timeout_s - waited_s, 0.0) : to_seconds(kSignalPeriod);
      std::optional<DaemonMessage> message;
      {
        const py::gil_scoped_release others_may_run;
        message = listener_->receive(from_seconds(std::min(left_s, to_seconds(kSignalPeriod))));
      }
      check_signals();
      if (message)
        return std::visit(
            [&](const auto& m) -> py::object {
              return py::make_tuple(kKinds[message->index()], fields_of(m));
            },
            *message);
      if (listener_->has_ended() || (timeout_s && left_s == 0.0)) return py::none();
    }
  }

  [[nodiscard]] bool has_ended() const { return listener_->has_ended(); }

 private:
  std::mutex mutex_;  // of whoever waits
  std::unique_ptr<MessageListener> listener_;
};

/// May hold the name of a file: decoded as Python's os.environ is.
py::str default_lcm_url() {
  const char* const named = std::getenv("LCM_DEFAULT_URL");
  PyObject* const url =
      PyUnicode_DecodeFSDefault(named == nullptr || *named == '\0' ? kDefaultLcmUrl : named);
  if (url == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(url);
}

void define_functions(py::module_& m) {
  m.def("version", [] { return version_text("swiftlet"); });
  m.def("default_lcm_url", &default_lcm_url);
  m.def("default_channel_prefix", [] { return PublishConfig{}.channel_prefix; });
  m.def(
      "map_input",
      [](const std::string& input, const std::optional<std::string>& output, const std::string& config_file,
         const std::string& settings, std::optional<int> beams, bool calibrate, bool odometry_only,
         bool frontend_only, const py::object& on_progress) {
        return map_input({.input = input,
                          .output_directory = output,
                          .config_file = config_file,
                          .settings = settings,
                          .beams = beams,
                          .calibrate = calibrate,
                          .odometry_only = odometry_only,
                          .frontend_only = frontend_only},
                         on_progress);
      },
      py::kw_only(), py::arg("input"), py::arg("output"), py::arg("config_file"), py::arg("settings"),
      py::arg("beams"), py::arg("calibrate"), py::arg("odometry_only"), py::arg("frontend_only"),
      py::arg("on_progress"));
}

void define_listener(py::module_& m) {
  py::class_<PythonListener>(m, "Listener")
      .def(py::init<const std::string&, const std::string&, const std::vector<std::string>&>(),
           py::arg("url"), py::arg("channel_prefix"), py::arg("channels"))
      .def("receive", &PythonListener::receive, py::arg("timeout_s"))
      .def("has_ended", &PythonListener::has_ended);
}

void define_error(py::module_& m) {
  static PyObject* error = nullptr;  // as long as the interpreter
  error = PyErr_NewExceptionWithDoc(
      "swiftlet.Error", "What cannot be done, in one line: what, where, and what to do.", nullptr, nullptr);
  if (error == nullptr) throw py::error_already_set();
  m.add_object("Error", error);
  // pybind11 gives the type of this function. NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const PythonError& e) {
      PyErr_SetObject(error, text_of(e.what()).ptr());
    }
  });
}

}  // namespace
}  // namespace swiftlet

PYBIND11_MODULE(_native, m) {
  swiftlet::define_error(m);
  swiftlet::define_functions(m);
  swiftlet::define_listener(m);
}
