// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Any lines as what matters of an HTTP request: method, host, target, subprotocols, origin where there is a
// fifth line. Byte 0, bit 0: a WebSocket is wanted.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "daemon/view/web_answer.hpp"
#include "tests/fuzz/shown_run.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kWelcome = "https://app.foxglove.dev";

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

WebRequest request_of(std::string_view text, bool wants_socket) {
  std::vector<std::string_view> lines;
  for_each_line(text, [&lines](std::string_view line) { lines.push_back(line); });
  const bool has_origin = lines.size() > 4;
  lines.resize(5);
  WebRequest request{.head = {.method = lines[0], .host = lines[1], .origin = {}},
                     .target = lines[2],
                     .subprotocols = {lines[3]},
                     .wants_socket = wants_socket};
  if (has_origin) request.head.origin = lines[4];
  return request;
}

/// A request of a foreign name or page, or one that changes something, gets nothing.
void check_admission(const RequestHead& head) {
  SWIFTLET_CHECK(head.method == "GET" || head.method == "HEAD", "requests read");
  const std::string host = lower(head.host);
  const std::string name = host.substr(host.starts_with('[') ? 1 : 0);
  SWIFTLET_CHECK(name.starts_with("localhost") || name.starts_with("127.") || name.starts_with("::1"),
                 "a request names this machine");
  if (!head.origin) return;
  const std::string origin = lower(*head.origin);
  SWIFTLET_CHECK(origin == "http://" + host || origin == kWelcome, "the page is ours or welcome");
}

void check(const WebRequest& request, const WebAnswer& answer) {
  if (answer.socket) {
    SWIFTLET_CHECK(answer.socket->path.find('?') == std::string_view::npos, "a path ends before a query");
    SWIFTLET_CHECK(answer.socket->subprotocols == request.subprotocols, "a site chooses the subprotocol");
  }
  if (answer.socket || answer.status == 200) check_admission(request.head);
}

}  // namespace
}  // namespace swiftlet

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it by this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  if (size == 0) return 0;
  static const PageFiles files{{"/", {"text/html", "page"}}, {"/view.js", {"text/javascript", "script"}}};
  static const OwnNames own{
      .is_loopback = true, .names = {"mybox"}, .foreign_origins = {std::string(kWelcome)}};
  const WebRequest request =
      request_of({reinterpret_cast<const char*>(data) + 1, size - 1}, (data[0] & 1U) != 0);
  check(request, answer_request(request, files, own));
  return 0;
}
