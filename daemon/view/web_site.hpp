// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/view/conversation.hpp"

namespace swiftlet {

/// A file as it is served.
struct PageFile {
  std::string_view content_type;
  std::string_view bytes;
};
/// By path; the bytes outlive the server.
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// A WebSocket that is asked for.
struct SocketRequest {
  std::string_view path;
  std::vector<std::string_view> subprotocols;  ///< that the client offers
};
struct SocketAnswer {
  std::unique_ptr<Conversation> conversation;  ///< nullptr: there is no such socket
  std::string_view subprotocol;                ///< one of those offered, of static lifetime; empty: none
};

/// What a WebServer serves. Called in its thread alone.
struct WebSite {
  PageFiles files;
  std::function<SocketAnswer(const SocketRequest&)> converse;
  std::vector<std::string> foreign_origins;  ///< of pages that may ask too, as request_check.hpp has them
};

}  // namespace swiftlet
