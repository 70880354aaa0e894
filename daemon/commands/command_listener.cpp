// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/command_listener.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "daemon/commands/command_message.hpp"
#include "daemon/commands/tcpq_conversation.hpp"
#include "daemon/publish/lcm_network.hpp"
#include "daemon/system/default_addresses.hpp"

namespace swiftlet {
namespace {

constexpr int kStopWaitMs = 100;  // the longest a stop goes unnoticed
constexpr std::size_t kMaxWarnings = 10;
constexpr std::chrono::seconds kSilence{1};  // a message may come in two pieces, 40 ms apart
constexpr std::uint32_t kLoopbackNet = 127;

using Steady = std::chrono::steady_clock;

class Connection {
 public:
  Connection(int socket, TcpqConversation conversation)
      : socket_(socket), conversation_(std::move(conversation)) {}
  Connection(Connection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)),
        conversation_(std::move(other.conversation_)),
        heard_at_(other.heard_at_) {}
  Connection& operator=(Connection&& other) noexcept {
    std::swap(socket_, other.socket_);
    std::swap(conversation_, other.conversation_);
    std::swap(heard_at_, other.heard_at_);
    return *this;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }

  [[nodiscard]] int socket() const { return socket_; }
  [[nodiscard]] bool is_silent() const { return Steady::now() - heard_at_ > kSilence; }
  /// False: it is over.
  bool read() {
    heard_at_ = Steady::now();
    std::array<std::uint8_t, 4096> bytes{};
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size < 0) return errno == EINTR || errno == EAGAIN;
    if (size == 0 || !conversation_.receive(std::span(bytes).first(static_cast<std::size_t>(size))))
      return false;
    const std::vector<std::uint8_t> answer = conversation_.take_answer();
    return answer.empty() || ::send(socket_, answer.data(), answer.size(), MSG_NOSIGNAL) > 0;
  }

 private:
  int socket_;
  TcpqConversation conversation_;
  Steady::time_point heard_at_ = Steady::now();
};

/// Reads where something waits, and takes out who is gone. Who said something stands last.
void read_all(std::vector<Connection>& connections, std::span<const pollfd> waits) {
  std::vector<Connection> heard;
  for (std::size_t i = connections.size(); i-- > 0;) {
    if (waits[i].revents == 0) continue;
    if (connections[i].read()) heard.push_back(std::move(connections[i]));
    connections.erase(connections.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::ranges::move(heard, std::back_inserter(connections));
}

Error refused(std::string_view address, const std::string& why) {
  return {ErrorCode::kInvalidInput, "commands on " + std::string(address) + ": " + why};
}

Result<sockaddr_in> loopback_address(std::string_view text) {
  const Error no_address = refused(text, "no address; write " + on_this_machine(kCommandsPort));
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return no_address;
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, port);
  if (error != std::errc() || rest != end) return no_address;
  const std::string named(text.substr(0, colon));
  const std::string host = named == "localhost" ? "127.0.0.1" : named;
  sockaddr_in bound{};
  bound.sin_family = AF_INET;
  bound.sin_port = htons(port);
  const bool is_address = inet_pton(AF_INET, host.c_str(), &bound.sin_addr) == 1;
  if (!is_address || ntohl(bound.sin_addr.s_addr) >> 24U != kLoopbackNet)
    return refused(text, "they are taken from this machine alone; write " + on_this_machine(kCommandsPort));
  return bound;
}

}  // namespace

Result<std::unique_ptr<CommandListener>> CommandListener::open(std::string_view address,
                                                               std::string channel) {
  const Result<sockaddr_in> bound = loopback_address(address);
  if (!bound) return bound.error();
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;
  if (socket >= 0 && ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
      ::bind(socket, std::bit_cast<const sockaddr*>(&*bound), sizeof(sockaddr_in)) == 0 &&
      ::listen(socket, kMaxConnections) == 0)
    return std::unique_ptr<CommandListener>(new CommandListener(socket, std::move(channel)));
  const std::string why = std::strerror(errno);
  if (socket >= 0) ::close(socket);
  return refused(address, why + "; name another port");
}

CommandListener::~CommandListener() {
  stop();
  ::close(socket_);
}

void CommandListener::start(Sink sink) {
  sink_ = std::move(sink);
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "commands");
    run(stop);
  });
}

void CommandListener::stop() {
  if (thread_.joinable()) thread_ = {};
}

std::string CommandListener::url() const {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  ::getsockname(socket_, std::bit_cast<sockaddr*>(&bound), &size);
  return lcm_server_url(bound);
}

void CommandListener::run(const std::stop_token& stop) {
  std::vector<Connection> connections;  // who has been silent longest stands first
  while (!stop.stop_requested()) {
    const bool has_room = connections.size() < kMaxConnections || connections.front().is_silent();
    std::vector<pollfd> waits{{.fd = has_room ? socket_ : -1, .events = POLLIN, .revents = 0}};
    for (const Connection& connection : connections)
      waits.push_back({.fd = connection.socket(), .events = POLLIN, .revents = 0});
    if (::poll(waits.data(), waits.size(), kStopWaitMs) <= 0) continue;
    read_all(connections, std::span(waits).subspan(1));
    if (waits.front().revents == 0) continue;
    const int accepted = ::accept4(socket_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (accepted < 0) {  // no descriptor is free: it still waits
      std::this_thread::sleep_for(std::chrono::milliseconds(kStopWaitMs));
      continue;
    }
    if (connections.size() == kMaxConnections) connections.erase(connections.begin());
    connections.emplace_back(
        accepted, TcpqConversation([this](std::string_view channel, std::span<const std::uint8_t> message) {
          on_message(channel, message);
        }));
  }
}

void CommandListener::on_message(std::string_view channel, std::span<const std::uint8_t> message) {
  if (channel != channel_) {
    if (!std::exchange(has_told_channel_, true))
      spdlog::warn("a message on another channel than {} was left out; do both programs have one prefix?",
                   channel_);
    return;
  }
  const Result<Command> command = read_command(message);
  if (!command) return warn("a command was not understood: " + command.error().message);
  if (!sink_(*command)) warn("a command was refused: too many came before it");
}

void CommandListener::warn(const std::string& why) {
  if (++warnings_ <= kMaxWarnings) spdlog::warn("{}", why);
}

}  // namespace swiftlet
