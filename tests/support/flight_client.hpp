// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/time.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {

/// Another program on a UDP port that stands for a vehicle: does what the vendor's client library does there.
/// Every request is sent once, the next one after its answer; it has no other idea of whether it is served.
/// One thread at a time; allocates.
class FlightClient {
 public:
  using Packet = std::vector<std::uint8_t>;
  /// How long it waits for an answer before it counts the request as lost and goes on.
  static constexpr Duration kPatience = std::chrono::seconds(2);

  explicit FlightClient(std::uint16_t port);
  ~FlightClient();
  FlightClient(const FlightClient&) = delete;
  FlightClient& operator=(const FlightClient&) = delete;

  /// Receives what has arrived, asks the next question, and sends a ping a second. Never waits.
  void step(HostTime now);

  /// For poll(): readable when something has arrived.
  [[nodiscard]] int file() const { return socket_; }

  /// At once, beside all questions.
  void send(std::span<const std::uint8_t> packet) const;
  void send(const CrtpPacket& packet) const { send(bytes_of(packet)); }
  /// A question, after those before it.
  void ask(const CrtpPacket& request) { questions_.push_back(request); }
  /// Asks all that the library asks when it connects: source, version, reset of the log, log table, memories,
  /// parameter table, every parameter.
  void connect();
  void ask_for_table(const CrtpTopic& topic);
  /// Of floats, each a variable of the log table.
  void start_block(std::uint8_t block, std::span<const std::uint16_t> variables, std::uint8_t period_10ms);

  [[nodiscard]] bool is_idle() const { return questions_.empty() && !open_; }
  /// Questions without an answer.
  [[nodiscard]] std::size_t unanswered() const { return unanswered_; }
  /// Answers that do not fit the question: of another, or one too many.
  [[nodiscard]] const std::vector<Packet>& strange() const { return strange_; }
  /// Of the last question about that block and command; nullopt: none.
  [[nodiscard]] std::optional<LogError> answer_to(LogCommand command, std::uint8_t block) const;
  /// How many items each table has, by port, and how many were received.
  [[nodiscard]] std::size_t table_size(std::uint8_t port) const;
  [[nodiscard]] std::size_t items_received(std::uint8_t port) const;
  [[nodiscard]] std::uint16_t log_variable(const std::string& name) const { return log_ids_.at(name); }
  /// Log data packets received, by block.
  [[nodiscard]] const std::map<std::uint8_t, std::vector<Packet>>& data() const { return data_; }
  [[nodiscard]] const std::string& console() const { return console_; }
  [[nodiscard]] std::size_t nulls() const { return nulls_; }
  /// Pings that were sent, and that came back.
  [[nodiscard]] std::size_t pings() const { return pings_; }
  [[nodiscard]] std::size_t pongs() const { return pongs_; }

 private:
  void on_packet(const Packet& packet);
  [[nodiscard]] bool answers(const Packet& packet) const;
  void on_answer(const Packet& packet);
  void on_table(const Packet& packet);

  int socket_;
  std::deque<CrtpPacket> questions_;
  std::optional<CrtpPacket> open_;
  HostTime asked_at_{};
  std::size_t unanswered_ = 0;
  std::vector<Packet> strange_;
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> log_answers_;
  std::map<std::uint8_t, std::size_t> table_sizes_;
  std::map<std::uint8_t, std::size_t> items_;
  std::map<std::string, std::uint16_t> log_ids_;
  std::map<std::uint8_t, std::vector<Packet>> data_;
  std::string console_;
  std::size_t nulls_ = 0;
  HostTime pinged_at_{};
  std::size_t pings_ = 0;
  std::size_t pongs_ = 0;
};

}  // namespace swiftlet
