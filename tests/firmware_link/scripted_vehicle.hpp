// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/crtp_packet.hpp"
#include "firmware_link/crtp/log_value.hpp"
#include "tests/firmware_link/frames.hpp"

namespace swiftlet {

/// Answers the requests of a log handshake as the firmware does, errors included; its log data is constant.
class ScriptedVehicle {
 public:
  struct Variable {
    std::string group;
    std::string name;
    LogType type = LogType::kFloat;
  };
  struct Block {
    std::vector<std::pair<LogType, std::uint16_t>> entries;
    bool running = false;
  };

  struct Param {
    std::string group;
    std::string name;
    std::uint8_t value = 0;
  };

  std::vector<Variable> variables;
  std::vector<Param> params{{"deck", "bcMultiranger", 1}, {"deck", "bcFlow2", 1}};
  std::uint8_t protocol = 12;
  std::string source = "Bitcraze Crazyflie";
  bool knows_its_type = true;  ///< firmware before 2019 does not answer that request
  std::map<std::uint8_t, Block> blocks;
  std::size_t room = 128;  ///< variables in all blocks

  static std::vector<Variable> modern_variables() {
    return {{"stateEstimate", "x", LogType::kFloat},  {"stateEstimate", "y", LogType::kFloat},
            {"stateEstimate", "z", LogType::kFloat},  {"stateEstimate", "yaw", LogType::kFloat},
            {"stateEstimate", "qx", LogType::kFloat}, {"stateEstimate", "qy", LogType::kFloat},
            {"stateEstimate", "qz", LogType::kFloat}, {"stateEstimate", "qw", LogType::kFloat},
            {"stateEstimateZ", "x", LogType::kInt16}, {"stateEstimateZ", "y", LogType::kInt16},
            {"stateEstimateZ", "z", LogType::kInt16}, {"range", "front", LogType::kUint16},
            {"range", "back", LogType::kUint16},      {"range", "left", LogType::kUint16},
            {"range", "right", LogType::kUint16},     {"range", "zrange", LogType::kUint16},
            {"supervisor", "info", LogType::kUint16}, {"pm", "vbatMV", LogType::kUint16},
            {"radio", "rssi", LogType::kUint8}};
  }

  /// The reply to a request; nullopt: the firmware does not answer.
  std::optional<Bytes> answer(std::span<const std::uint8_t> request) {
    if (is_on(request, kLinkSourceTopic)) {
      Bytes reply{0xFD};
      reply.insert(reply.end(), source.begin(), source.end());
      reply.resize(31, 0);
      return reply;
    }
    if (is_on(request, kPlatformVersionTopic)) return answer_version(request);
    if (is_on(request, kParamTocTopic)) return answer_param_toc(request);
    if (is_on(request, kParamReadTopic)) return answer_param_read(request);
    if (is_on(request, kLinkEchoTopic)) return Bytes(request.begin(), request.end());
    if (is_on(request, kLogTocTopic)) return answer_toc(request);
    if (is_on(request, kLogControlTopic)) return answer_control(request);
    return std::nullopt;
  }

  /// One packet of each running block.
  [[nodiscard]] std::vector<Bytes> data(std::uint32_t time_ms) const {
    std::vector<Bytes> packets;
    for (const auto& [id, block] : blocks) {
      if (!block.running) continue;
      LogPacket packet(id, time_ms);
      for (const auto& [type, variable] : block.entries) {
        if (size_of(type) == 1) packet.u8(0);
        if (size_of(type) == 2) packet.u16(variable == 0 ? 0 : 1000);
        if (size_of(type) == 4) packet.f32(variables[variable].name == "qw" ? 1.0F : 0.0F);
      }
      packets.push_back(packet.bytes());
    }
    return packets;
  }

 private:
  [[nodiscard]] std::optional<Bytes> answer_version(std::span<const std::uint8_t> request) const {
    if (request[1] == 0) return Bytes{0xDD, 0, protocol, 0, 0, 0};
    if (request[1] == 2 && !knows_its_type) return std::nullopt;
    const std::string text = request[1] == 1 ? "2026.08" : "Crazyflie 2.1";
    Bytes reply{0xDD, request[1]};
    reply.insert(reply.end(), text.begin(), text.end());
    return reply;
  }
  [[nodiscard]] Bytes answer_param_toc(std::span<const std::uint8_t> request) const {
    if (request[1] == 3) {
      const auto count = static_cast<std::uint16_t>(params.size());
      return {0x20, 3, low_byte(count), high_byte(count), 5, 6, 7, 8};
    }
    const std::uint16_t id = load_u16(request, 2);
    if (id >= params.size()) return {0x20, 2};
    Bytes reply = toc_item_reply(id, LogType::kHalf, params[id].group, params[id].name);
    reply[0] = 0x20;
    return reply;
  }
  [[nodiscard]] Bytes answer_param_read(std::span<const std::uint8_t> request) const {
    const std::uint16_t id = load_u16(request, 1);
    if (id >= params.size()) return {0x2D, request[1], request[2], 2};
    return {0x2D, request[1], request[2], 0, params[id].value};
  }

  Bytes answer_toc(std::span<const std::uint8_t> request) const {
    if (request[1] == 3) {
      const auto count = static_cast<std::uint16_t>(variables.size());
      return {0x50, 3, low_byte(count), high_byte(count), 1, 2, 3, 4, 16, 128};
    }
    const std::uint16_t id = load_u16(request, 2);
    if (id >= variables.size()) return {0x50, 2};
    return toc_item_reply(id, variables[id].type, variables[id].group, variables[id].name);
  }

  Bytes answer_control(std::span<const std::uint8_t> request) {
    const auto command = static_cast<LogCommand>(request[1]);
    const std::uint8_t id = request.size() > 2 ? request[2] : 0xF8;
    LogError error = LogError::kNone;
    const bool known = blocks.contains(id);
    if (command == LogCommand::kReset) {
      blocks.clear();
    } else if (command == LogCommand::kCreate) {
      error = known ? LogError::kExists : fill(blocks[id], request);
    } else if (!known) {
      error = LogError::kUnknown;
    } else if (command == LogCommand::kAppend) {
      error = fill(blocks[id], request);
    } else if (command == LogCommand::kDelete) {
      blocks.erase(id);
    } else {
      blocks[id].running = command == LogCommand::kStart;
    }
    return {0x5D, request[1], id, static_cast<std::uint8_t>(error)};
  }

  LogError fill(Block& block, std::span<const std::uint8_t> request) {
    for (std::size_t at = 3; at + 3 <= request.size(); at += 3) {
      const LogType type = *log_type_of(request[at]);
      std::size_t bytes = size_of(type);
      for (const auto& entry : block.entries) bytes += size_of(entry.first);
      const std::uint16_t variable = load_u16(request, at + 1);
      if (variable >= variables.size()) return LogError::kUnknown;
      if (bytes > kMaxLogBytes) return LogError::kTooBig;
      if (block.entries.size() >= room) return LogError::kNoRoom;
      block.entries.emplace_back(type, variable);
    }
    return LogError::kNone;
  }
};

/// A link to a scripted vehicle in simulated time: a request is answered 1 ms later unless it is lost on the
/// way (then nothing happens) or its answer is; running blocks send every 100 ms.
class ScriptedLink final : public Link {
 public:
  enum class Fate { kArrives, kRequestLost, kAnswerLost };

  ScriptedVehicle vehicle;
  std::function<Fate(std::span<const std::uint8_t>)> fate = [](auto) { return Fate::kArrives; };
  /// False: nothing passes, either way.
  std::function<bool(std::int64_t)> reaches = [](std::int64_t) { return true; };
  std::vector<Bytes> requests;
  std::int64_t booted_ms = 0;  ///< the vehicle's clock counts from then
  std::int64_t now_ms = 0;
  std::int64_t last_ms = 60'000;

  Status send(std::span<const std::uint8_t> packet) override {
    requests.emplace_back(packet.begin(), packet.end());
    frames_.push_back(sent(requests.back(), host_ms(now_ms)));
    const Fate what = reaches(now_ms) ? fate(packet) : Fate::kRequestLost;
    if (what == Fate::kRequestLost) return {};
    const std::optional<Bytes> reply = vehicle.answer(packet);
    if (reply && what == Fate::kArrives) frames_.push_back(received(*reply, host_ms(now_ms + 1)));
    return {};
  }
  Result<LinkFrame> receive(Duration timeout) override {
    if (frames_.empty()) {
      const std::int64_t next_ms = (now_ms / 100 + 1) * 100;
      const std::int64_t patience_ms = timeout / std::chrono::milliseconds(1);
      const bool is_due = next_ms - now_ms <= patience_ms;
      now_ms = is_due ? next_ms : now_ms + patience_ms;
      if (now_ms > last_ms) return Error{ErrorCode::kEndOfRecording, "landed"};
      if (!is_due) return Error{ErrorCode::kTimeout, "no packet"};
      for (const Bytes& packet : vehicle.data(static_cast<std::uint32_t>(now_ms - booted_ms)))
        if (reaches(now_ms)) frames_.push_back(received(packet, host_ms(now_ms)));
      if (frames_.empty()) return Error{ErrorCode::kTimeout, "no packet"};
    }
    const LinkFrame frame = frames_.front();
    frames_.pop_front();
    return frame;
  }

 private:
  std::deque<LinkFrame> frames_;
};

}  // namespace swiftlet
