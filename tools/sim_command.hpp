// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "firmware_link/link/udp_address.hpp"

namespace swiftlet {

/// The options of `swiftlet sim`.
struct SimCommand {
  std::string world = "office";
  std::uint64_t seed = 1;
  std::string udp = kLocalUdpAddress;      ///< IPv4 address and port to listen on
  int laps = 1;                            ///< of the world's script, each 6 to 8 minutes; then it lands
  std::optional<double> battery_minutes;   ///< in flight; unset: enough for all laps
  double clock_start_s = 4.0;              ///< the vehicle's clock at first
  double loss_percent = 0.0;               ///< of packets, each way
  double delay_ms = 0.0;                   ///< of what the vehicle sends
  double duplicates_percent = 0.0;         ///< of what the vehicle sends
  bool steered = false;                    ///< by its client's setpoints
  std::vector<std::string> missing_decks;  ///< flow, multiranger
};

/// Puts a simulated vehicle on UDP in real time until SIGINT, SIGTERM, SIGHUP or the instruction `quit`.
/// Instructions are read from stdin, one a line (sim_instructions_help()); the end of stdin does not end the
/// simulation, nor need stdin be open. Prints to stdout, a line each, where it listens, which clients come
/// and go, what the vehicle does, and what is wrong with an instruction. To be called before any other thread
/// runs.
///
/// Errors: kNotFound, kInvalidInput: world, deck or address cannot be used, or the port is in use.
[[nodiscard]] Status run_sim_command(const SimCommand& command);

}  // namespace swiftlet
