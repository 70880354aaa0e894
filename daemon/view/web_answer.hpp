// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "daemon/view/request_check.hpp"
#include "daemon/view/web_site.hpp"

namespace swiftlet {

/// What matters of a request for its answer.
struct WebRequest {
  RequestHead head;
  std::string_view target;                     ///< path and query
  std::vector<std::string_view> subprotocols;  ///< that the client of a WebSocket offers
  bool wants_socket = false;
  bool keeps_alive = false;  ///< the connection may bring another request
};

/// What is answered; views the request and the files.
struct WebAnswer {
  int status = 200;  ///< of HTTP
  PageFile file;
  bool keeps_alive = false;
  std::optional<SocketRequest> socket{};  ///< instead of the file
};

/// Which of the files, or which WebSocket; what refuse_request() refuses gets neither.
[[nodiscard]] WebAnswer answer_request(const WebRequest& request, const PageFiles& files,
                                       const OwnNames& own);

}  // namespace swiftlet
