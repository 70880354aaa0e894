// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.hpp"
#include "daemon/view/viewer.hpp"
#include "daemon/view/web_server.hpp"

namespace swiftlet {

/// Serves the page of a run, and the same to Foxglove, from a history that others fill. Its thread yields to
/// others.
class ViewService {
 public:
  /// Pages of `foreign_origins` may look, too. Error: kInvalidInput: it cannot listen there.
  [[nodiscard]] static Result<std::unique_ptr<ViewService>> open(
      const ListenAddress& address, const ShownSource& source,
      const std::vector<std::string>& foreign_origins);
  ~ViewService();
  ViewService(const ViewService&) = delete;
  ViewService& operator=(const ViewService&) = delete;

  [[nodiscard]] const WebServer& server() const { return *server_; }
  /// Any thread, with its mutex.
  [[nodiscard]] SharedRunHistory& shared() { return shared_; }

 private:
  explicit ViewService(const ShownSource& source) : source_(source) {}

  SharedRunHistory shared_;
  ShownSource source_;
  std::unique_ptr<WebServer> server_;
  std::jthread thread_;

  void serve(const std::stop_token& stop);
};

/// Reads the messages of a swiftletd into the history, until `stop` is requested or a log (file://) has
/// ended; `after_message`, where it is set, is called after each, with the mutex held. Error: as
/// LcmTransport::open().
[[nodiscard]] Status view_lcm(const std::string& url, const std::string& channel_prefix,
                              SharedRunHistory& shared, const std::stop_token& stop,
                              const std::function<void()>& after_message);

}  // namespace swiftlet
