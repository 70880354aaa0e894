// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/flight_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "core/base/check.hpp"
#include "firmware_link/crtp/byte_order.hpp"
#include "firmware_link/crtp/toc_item.hpp"
#include "firmware_link/link/link_packet.hpp"

namespace swiftlet {
namespace {

constexpr CrtpTopic kConsoleTopic{0, 0};
constexpr CrtpTopic kMemoryTopic{4, 0};
constexpr CrtpTopic kParamChangedTopic{2, 3};
constexpr std::uint8_t kFloat = 7;
constexpr Duration kPingPeriod = std::chrono::seconds(1);

}  // namespace

FlightClient::FlightClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool is_associated =
      ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  SWIFTLET_CHECK(is_associated, "the loopback takes a socket");
}

FlightClient::~FlightClient() { ::close(socket_); }

void FlightClient::send(std::span<const std::uint8_t> packet) const {
  static_cast<void>(::send(socket_, packet.data(), packet.size(), MSG_NOSIGNAL));
}

void FlightClient::step(HostTime now) {
  std::array<std::uint8_t, 64> buffer{};
  for (;;) {
    const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), 0);
    if (size <= 0) break;
    on_packet(Packet(buffer.begin(), buffer.begin() + size));
  }
  if (open_ && now - asked_at_ > kPatience) {
    ++unanswered_;
    open_.reset();
  }
  if (now - pinged_at_ >= kPingPeriod) {
    pinged_at_ = now;
    send(make_crtp_packet(kLinkEchoTopic, {0, low_byte(static_cast<unsigned>(++pings_)), 2, 3}));
  }
  if (open_ || questions_.empty()) return;
  open_ = questions_.front();
  questions_.pop_front();
  asked_at_ = now;
  send(*open_);
}

void FlightClient::connect() {
  ask(source_request());
  ask(version_request(VersionQuery::kProtocol));
  ask(log_reset_request());
  ask_for_table(kLogTocTopic);
  ask(make_crtp_packet(kMemoryTopic, {1}));
  ask_for_table(kParamTocTopic);
}

void FlightClient::ask_for_table(const CrtpTopic& topic) { ask(toc_info_request(topic)); }

void FlightClient::start_block(std::uint8_t block, std::span<const std::uint16_t> variables,
                               std::uint8_t period_10ms) {
  CrtpPacket request = log_block_request(LogCommand::kCreate, block);
  for (const std::uint16_t variable : variables) {
    const bool fits = add_log_entry(request, kFloat, variable);
    SWIFTLET_CHECK(fits, "at most nine");
  }
  ask(request);
  ask(log_start_request(block, period_10ms));
}

void FlightClient::on_packet(const Packet& packet) {
  if (is_null_packet(packet)) {
    ++nulls_;
  } else if (is_on(packet, kConsoleTopic)) {
    console_.append(packet.begin() + 1, packet.end());
  } else if (is_on(packet, kLogDataTopic) && packet.size() > 1) {
    data_[packet[1]].push_back(packet);
  } else if (is_on(packet, kLinkEchoTopic)) {
    ++pongs_;
  } else if (is_on(packet, kParamChangedTopic)) {
    return;
  } else if (answers(packet)) {
    on_answer(packet);
  } else {
    strange_.push_back(packet);
  }
}

/// By port, channel and, but for the link's source, the first byte of data.
bool FlightClient::answers(const Packet& packet) const {
  if (!open_ || ((packet[0] ^ (*open_)[0]) & 0xF3U) != 0) return false;
  if (is_on(packet, kLinkSourceTopic)) return true;
  const bool is_log_control = is_on(packet, kLogControlTopic);
  const bool is_item = (is_on(packet, kLogTocTopic) || is_on(packet, kParamTocTopic)) && packet[1] == 2;
  const std::size_t compared = is_item ? 4 : is_log_control && open_->size() > 2 ? 3 : 2;
  return packet.size() >= compared && open_->size() >= compared &&
         std::equal(packet.begin() + 1, packet.begin() + static_cast<std::ptrdiff_t>(compared),
                    open_->begin() + 1);
}

void FlightClient::on_answer(const Packet& packet) {
  if (is_on(packet, kLogControlTopic) && packet.size() >= 4) {
    const std::uint8_t block = open_->size() > 2 ? packet[2] : std::uint8_t{0};
    log_answers_[{packet[1], block}] = packet[3];
  }
  if (is_on(packet, kLogTocTopic) || is_on(packet, kParamTocTopic)) on_table(packet);
  open_.reset();
}

void FlightClient::on_table(const Packet& packet) {
  const auto port = static_cast<std::uint8_t>(packet[0] >> 4U);
  const CrtpTopic topic{port, 0};
  if (const std::optional<TocInfo> info = read_toc_info(packet)) {
    table_sizes_[port] = info->count;
    for (std::uint16_t id = 0; id < info->count; ++id) ask(toc_item_request(topic, id));
    if (port != kParamTocTopic.port) return;
    for (std::uint16_t id = 0; id < info->count; ++id) ask(param_read_request(id));
  } else if (const std::optional<TocItem> item = read_toc_item(packet)) {
    ++items_[port];
    if (port == kLogTocTopic.port) log_ids_[item->name] = item->id;
  }
}

std::optional<LogError> FlightClient::answer_to(LogCommand command, std::uint8_t block) const {
  const auto found = log_answers_.find({static_cast<std::uint8_t>(command), block});
  if (found == log_answers_.end()) return std::nullopt;
  return static_cast<LogError>(found->second);
}

std::size_t FlightClient::table_size(std::uint8_t port) const {
  const auto found = table_sizes_.find(port);
  return found == table_sizes_.end() ? 0 : found->second;
}

std::size_t FlightClient::items_received(std::uint8_t port) const {
  const auto found = items_.find(port);
  return found == items_.end() ? 0 : found->second;
}

}  // namespace swiftlet
