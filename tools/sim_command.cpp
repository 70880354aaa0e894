// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/sim_command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <utility>

#include "daemon/system/signal_watcher.hpp"
#include "firmware_link/link/link_clock.hpp"
#include "firmware_link/simulation/sensor_errors.hpp"
#include "firmware_link/simulation/udp_server.hpp"
#include "tools/sim_instruction.hpp"

namespace swiftlet {
namespace {

constexpr int kWaitMs = 1;       // the vehicle's clock ticks in milliseconds
constexpr int kIdleWaitMs = 20;  // without a client
constexpr double kLapMinutes = 8.0;

struct ListenAddress {
  std::string host;
  std::uint16_t port = 0;
};

Result<ListenAddress> parse_listen_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    ListenAddress address{.host = text.substr(0, colon)};
    const char* const begin = text.data() + colon + 1;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(begin, end, address.port);
    if (error == std::errc() && rest == end) return address;
  }
  return Error{ErrorCode::kInvalidInput,
               "'" + text + "' is no address to listen on; write " + kLocalUdpAddress};
}

Result<VehicleModel> model_for(const SimCommand& command, const SimulatedWorld& world) {
  VehicleModel model = vehicle_model_in(world, command.seed);
  model.pilot.laps = command.laps;
  model.clock_start = from_seconds(command.clock_start_s);
  model.battery_endurance = from_seconds(60.0 * command.battery_minutes.value_or(kLapMinutes * command.laps));
  model.link_timeout = kRadioLinkTimeout;
  model.prints_boot_text = true;
  model.is_steered = command.steered;
  for (const std::string& name : command.missing_decks) {
    const Result<SimulatedDeck> deck = parse_deck(name);
    if (!deck) return deck.error();
    (*deck == SimulatedDeck::kFlow ? model.has_flow_deck : model.has_multiranger) = false;
  }
  return model;
}

void print_line(const std::string& notice) {
  std::printf("%s\n", notice.c_str());
  std::fflush(stdout);
}

/// Reports what has changed since its last call.
class ChangeReporter {
 public:
  ChangeReporter(const SimulatedUdpServer& server, const SimulatedVehicle& vehicle)
      : server_(server), vehicle_(vehicle) {}

  void report() {
    const std::optional<std::string> client = server_.client();
    if (client != client_)
      print_line(client ? "client " + *client + " connected" : "client " + *client_ + " gone");
    client_ = client;
    report(was_on_air_, vehicle_.is_on_air(), "vehicle on air", "vehicle silent");
    report(was_flying_, vehicle_.is_flying(), "took off",
           vehicle_.is_finished() ? "landed" : "flight interrupted");
  }

 private:
  static void report(bool& was, bool is, const char* begun, const char* ended) {
    if (was != is) print_line(is ? begun : ended);
    was = is;
  }

  const SimulatedUdpServer& server_;
  const SimulatedVehicle& vehicle_;
  std::optional<std::string> client_;
  bool was_on_air_ = true;
  bool was_flying_ = false;
};

/// Without stdin the next file that is opened has its number: the server's socket.
bool stdin_is_open() { return ::fcntl(STDIN_FILENO, F_GETFD) >= 0; }

/// stdin, line by line, without waiting.
class InstructionReader {
 public:
  explicit InstructionReader(bool has_stdin) : is_over_(!has_stdin) {}

  /// After the end: -1, which poll() ignores.
  [[nodiscard]] int fd() const { return is_over_ ? -1 : STDIN_FILENO; }
  /// To be called when poll() reports input.
  void read_some() {
    std::array<char, 256> buffer{};
    const ssize_t size = read(STDIN_FILENO, buffer.data(), buffer.size());
    if (size > 0)
      text_.append(buffer.data(), static_cast<std::size_t>(size));
    else
      is_over_ = true;
  }
  /// The last one needs no end of line.
  [[nodiscard]] std::optional<std::string> next_line() {
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos && (!is_over_ || text_.empty())) return std::nullopt;
    std::string line = text_.substr(0, end);
    text_.erase(0, end == std::string::npos ? end : end + 1);
    return line;
  }

 private:
  std::string text_;
  bool is_over_;
};

/// False: quit.
bool execute(const SimInstruction& instruction, SimulatedVehicle& vehicle, SimulatedUdpServer& server) {
  PacketFaults faults = server.faults();
  switch (instruction.kind) {
    case SimInstruction::Kind::kNothing:
      break;
    case SimInstruction::Kind::kReboot:
      vehicle.reboot();
      break;
    case SimInstruction::Kind::kSilence:
      server.silence(instruction.duration);
      break;
    case SimInstruction::Kind::kFreeze:
      vehicle.freeze_ranges(instruction.duration);
      break;
    case SimInstruction::Kind::kResetEstimator:
      vehicle.reset_estimator();
      break;
    case SimInstruction::Kind::kLoss:
      faults.loss_share = instruction.share;
      break;
    case SimInstruction::Kind::kDelay:
      faults.delay = instruction.duration;
      break;
    case SimInstruction::Kind::kDuplicates:
      faults.duplicate_share = instruction.share;
      break;
    case SimInstruction::Kind::kUnplugDeck:
      vehicle.unplug(instruction.deck);
      break;
    case SimInstruction::Kind::kHelp:
      std::fputs(sim_instructions_help().data(), stdout);
      break;
    case SimInstruction::Kind::kQuit:
      return false;
  }
  server.set_faults(faults);
  return true;
}

/// False: quit.
bool execute_lines(InstructionReader& reader, SimulatedVehicle& vehicle, SimulatedUdpServer& server) {
  while (const std::optional<std::string> line = reader.next_line()) {
    const Result<SimInstruction> instruction = parse_sim_instruction(*line);
    if (!instruction)
      print_line(instruction.error().message);
    else if (!execute(*instruction, vehicle, server))
      return false;
    else if (instruction->kind != SimInstruction::Kind::kNothing)
      print_line("done: " + *line);
  }
  return true;
}

void run_until_quit(InstructionReader& reader, SimulatedVehicle& vehicle, SimulatedUdpServer& server,
                    const std::stop_token& stop) {
  ChangeReporter changes(server, vehicle);
  while (!stop.stop_requested()) {
    std::array<pollfd, 2> watched{{{server.socket_fd(), POLLIN, 0}, {reader.fd(), POLLIN, 0}}};
    static_cast<void>(poll(watched.data(), watched.size(), server.client() ? kWaitMs : kIdleWaitMs));
    if (watched[1].revents != 0) reader.read_some();
    if (!execute_lines(reader, vehicle, server)) return;
    server.serve();
    changes.report();
  }
}

}  // namespace

Status run_sim_command(const SimCommand& command) {
  InstructionReader reader(stdin_is_open());  // before any file is opened
  const SignalWatcher signals;
  Result<SimulatedWorld> world = make_simulated_world(command.world, command.seed);
  if (!world) return world.error();
  const Result<VehicleModel> model = model_for(command, *world);
  if (!model) return model.error();
  const Result<ListenAddress> address = parse_listen_address(command.udp);
  if (!address) return address.error();
  SimulatedVehicle vehicle(std::move(*world), *model, command.seed);
  SystemLinkClock clock;
  const auto server = SimulatedUdpServer::open(address->host, address->port, vehicle, clock, command.seed);
  if (!server) return server.error();
  (*server)->set_faults({.loss_share = command.loss_percent / 100.0,
                         .duplicate_share = command.duplicates_percent / 100.0,
                         .delay = from_seconds(command.delay_ms / 1000.0)});
  print_line("listening on udp://" + (*server)->address() + ", world " + command.world + ", seed " +
             std::to_string(command.seed) + "; type help for instructions");
  run_until_quit(reader, vehicle, **server, signals.token());
  print_line("ended");
  return {};
}

}  // namespace swiftlet
