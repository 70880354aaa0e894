// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/web_server.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/view/request_check.hpp"
#include "daemon/view/web_answer.hpp"

namespace swiftlet {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::milliseconds kOfferPeriod{40};
constexpr std::chrono::seconds kHttpTimeout{15};
constexpr std::chrono::milliseconds kAcceptPause{100};  // after a failure: no descriptor is free, for example
constexpr std::size_t kMaxConnections = 64;
constexpr std::uint32_t kMaxHeaderBytes = 8192;
constexpr std::size_t kMaxMessageBytes = 4096;
constexpr const char* kSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src "
    "'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

using Request = http::request<http::empty_body>;
using Response = http::response<http::span_body<const char>>;

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

std::vector<std::string_view> items_of(std::string_view list) {
  std::vector<std::string_view> items;
  for (const auto item : http::token_list({list.data(), list.size()}))
    items.emplace_back(item.data(), item.size());
  return items;
}

WebRequest web_request(const Request& request) {
  WebRequest seen{.head = {.method = view_of(request.method_string()),
                           .host = view_of(request[http::field::host]),
                           .origin = {}},
                  .target = view_of(request.target()),
                  .subprotocols = items_of(view_of(request[http::field::sec_websocket_protocol])),
                  .wants_socket = websocket::is_upgrade(request),
                  .keeps_alive = request.keep_alive()};
  if (const auto origin = request.find(http::field::origin); origin != request.end())
    seen.head.origin = view_of(origin->value());
  if (request.count(http::field::host) > 1) seen.head.host = {};
  return seen;
}

/// Answers on one address.
struct Site {
  WebSite content;
  OwnNames names;
  std::size_t connections = 0;
};

/// One of the connections that are counted.
class CountedConnection {
 public:
  explicit CountedConnection(Site& site) : site_(site) { ++site_.connections; }
  ~CountedConnection() { --site_.connections; }
  CountedConnection(const CountedConnection&) = delete;
  CountedConnection& operator=(const CountedConnection&) = delete;

 private:
  Site& site_;
};

/// A WebSocket and what it carries.
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
 public:
  WebSocketSession(beast::tcp_stream stream, SocketAnswer answer, std::shared_ptr<CountedConnection> counted)
      : socket_(std::move(stream)),
        conversation_(std::move(answer.conversation)),
        subprotocol_(answer.subprotocol),
        counted_(std::move(counted)) {}

  void accept(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own times
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxMessageBytes);
    if (!subprotocol_.empty())
      socket_.set_option(
          websocket::stream_base::decorator([name = subprotocol_](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, beast::string_view(name.data(), name.size()));
          }));
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->is_open_ = true;
      self->read();
      self->offer();
    });
  }
  /// Sends the next message, unless one is on its way.
  void offer() {
    if (!is_open_ || is_writing_) return;
    std::optional<WebMessage> message = conversation_->next();
    if (!message) return;
    is_writing_ = true;
    sent_ = std::move(*message);
    socket_.text(sent_.is_text);
    socket_.async_write(asio::buffer(sent_.bytes),
                        [self = shared_from_this()](error_code error, std::size_t) { self->written(error); });
  }

 private:
  websocket::stream<beast::tcp_stream> socket_;
  std::unique_ptr<Conversation> conversation_;
  std::string_view subprotocol_;
  std::shared_ptr<CountedConnection> counted_;
  beast::flat_buffer received_;
  WebMessage sent_;
  bool is_open_ = false;
  bool is_writing_ = false;

  void written(error_code error) {
    is_writing_ = false;
    is_open_ = is_open_ && !error;
    offer();
  }
  void read() {
    socket_.async_read(received_, [self = shared_from_this()](error_code error, std::size_t) {
      self->is_open_ = self->is_open_ && !error;
      if (error) return;
      const auto bytes = self->received_.cdata();
      if (self->socket_.got_text())
        self->conversation_->take({static_cast<const char*>(bytes.data()), bytes.size()});
      self->received_.clear();
      self->offer();
      self->read();
    });
  }
};

/// Those that are open.
class OpenSockets {
 public:
  void add(const std::shared_ptr<WebSocketSession>& session) { sessions_.push_back(session); }
  void offer() {
    std::erase_if(sessions_, [](const auto& session) { return session.expired(); });
    for (const auto& weak : sessions_)
      if (const auto session = weak.lock()) session->offer();
  }

 private:
  std::vector<std::weak_ptr<WebSocketSession>> sessions_;
};

/// A connection that speaks HTTP, until it ends or becomes a WebSocket.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(tcp::socket socket, Site& site, OpenSockets& sockets)
      : stream_(std::move(socket)),
        site_(site),
        sockets_(sockets),
        counted_(std::make_shared<CountedConnection>(site)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    stream_.expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) { self->answer(error); });
  }

 private:
  beast::tcp_stream stream_;
  Site& site_;
  OpenSockets& sockets_;
  std::shared_ptr<CountedConnection> counted_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Response> response_;

  void answer(error_code error) {
    if (error == http::error::end_of_stream || error == beast::error::timeout) return close();
    if (error) return send(http::status::bad_request, {"text/plain", "this is no request\n"}, false);
    const WebAnswer answer = answer_request(web_request(parser_->get()), site_.content.files, site_.names);
    if (answer.socket) return upgrade(*answer.socket);
    send(static_cast<http::status>(answer.status), answer.file, answer.keeps_alive);
  }
  void upgrade(const SocketRequest& wanted) {
    SocketAnswer answer = site_.content.converse(wanted);
    if (!answer.conversation)
      return send(http::status::not_found, {"text/plain", "there is no such socket\n"}, false);
    const auto session =
        std::make_shared<WebSocketSession>(std::move(stream_), std::move(answer), std::move(counted_));
    sockets_.add(session);
    session->accept(parser_->get());
  }
  void send(http::status status, const PageFile& file, bool keep_alive) {
    const bool is_head = parser_->is_header_done() && parser_->get().method() == http::verb::head;
    response_.emplace(status, 11);
    response_->set(http::field::content_type,
                   beast::string_view(file.content_type.data(), file.content_type.size()));
    response_->set(http::field::cache_control, "no-cache");
    response_->set("Content-Security-Policy", kSecurityPolicy);
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Referrer-Policy", "no-referrer");
    response_->set("Cross-Origin-Resource-Policy", "same-origin");
    response_->keep_alive(keep_alive);
    if (!is_head) response_->body() = {file.bytes.data(), file.bytes.size()};
    response_->content_length(file.bytes.size());
    stream_.expires_after(kHttpTimeout);
    write(is_head);
  }
  void write(bool is_head) {
    const auto done = [self = shared_from_this()](error_code error, std::size_t) {
      if (error || self->response_->need_eof()) return self->close();
      self->read();
    };
    if (!is_head) return http::async_write(stream_, *response_, done);
    auto serializer = std::make_shared<http::response_serializer<http::span_body<const char>>>(*response_);
    http::async_write_header(stream_, *serializer,
                             [serializer, done](error_code error, std::size_t size) { done(error, size); });
  }
  void close() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }
};

Error no_address(std::string_view text) {
  return {ErrorCode::kInvalidInput,
          "'" + std::string(text) + "' is no address to listen on; write " + on_this_machine(kViewPort)};
}

Result<tcp::endpoint> endpoint_of(const ListenAddress& address) {
  error_code error;
  const std::string host = address.host == "localhost" ? "127.0.0.1" : address.host;
  const asio::ip::address ip = asio::ip::make_address(host, error);
  if (!error) return tcp::endpoint(ip, address.port);
  return no_address(address.host);
}

}  // namespace

struct WebServer::State {
  Site site;  // outlives the sessions, which the context holds
  OpenSockets sockets;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer offer_timer{io};
  asio::steady_timer accept_timer{io};

  Status listen(const ListenAddress& address) {
    const Result<tcp::endpoint> endpoint = endpoint_of(address);
    if (!endpoint) return endpoint.error();
    error_code error;
    acceptor.open(endpoint->protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(*endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return {};
    return Error{ErrorCode::kInvalidInput, "cannot listen on " + address.host + ":" +
                                               std::to_string(address.port) + ": " + error.message() +
                                               "; name another address or port"};
  }
  void accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (error) return pause();
      if (site.connections < kMaxConnections)
        std::make_shared<HttpSession>(std::move(socket), site, sockets)->read();
      accept();
    });
  }
  void pause() {
    accept_timer.expires_after(kAcceptPause);
    accept_timer.async_wait([this](error_code error) {
      if (!error) accept();
    });
  }
  void offer_now_and_then() {
    offer_timer.expires_after(kOfferPeriod);
    offer_timer.async_wait([this](error_code error) {
      if (error) return;
      sockets.offer();
      offer_now_and_then();
    });
  }
};

Result<ListenAddress> parse_listen_address(std::string_view text) {
  ListenAddress address;
  const std::size_t colon = text.ends_with(']') ? std::string_view::npos : text.rfind(':');
  address.host = text.substr(0, colon);
  if (address.host.starts_with('[') && address.host.ends_with(']'))
    address.host = address.host.substr(1, address.host.size() - 2);
  const char* const end = text.data() + text.size();
  bool is_port = true;
  if (colon != std::string_view::npos) {
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, address.port);
    is_port = error == std::errc() && rest == end;
  }
  if (is_port && endpoint_of(address)) return address;
  return no_address(text);
}

Result<std::unique_ptr<WebServer>> WebServer::open(const ListenAddress& address, WebSite site) {
  auto state = std::make_unique<State>();
  if (Status listening = state->listen(address); !listening) return listening.error();
  state->site.names = own_names(address.host);
  state->site.names.foreign_origins = site.foreign_origins;
  state->site.content = std::move(site);
  return std::unique_ptr<WebServer>(new WebServer(std::move(state)));
}

WebServer::WebServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
WebServer::~WebServer() = default;

std::string WebServer::url() const {
  const tcp::endpoint local = state_->acceptor.local_endpoint();
  const std::string host = local.address().to_string();
  return "http://" + (local.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(local.port());
}

bool WebServer::is_beyond_this_machine() const { return !state_->site.names.is_loopback; }

void WebServer::run(const std::stop_token& stop) {
  const std::stop_callback ends(stop, [this] { state_->io.stop(); });
  state_->accept();
  state_->offer_now_and_then();
  state_->io.run();
}

}  // namespace swiftlet
