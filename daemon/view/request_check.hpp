// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet {

/// Which names a browser may have used to come here. Any other name may be a foreign one that resolves to
/// this machine (DNS rebinding). An address cannot be that.
struct OwnNames {
  bool is_loopback = true;         ///< listens within the machine: loopback addresses and localhost alone
  std::vector<std::string> names;  ///< otherwise addresses, localhost and these
  /// Pages of these may ask, too, as their browsers name them: "https://app.foxglove.dev", "file://".
  std::vector<std::string> foreign_origins{};
};
/// For a server that listens on `host`.
[[nodiscard]] OwnNames own_names(const std::string& host);

/// What matters of a request before its content does.
struct RequestHead {
  std::string_view method;
  std::string_view host;                   ///< empty: not said
  std::optional<std::string_view> origin;  ///< browsers name it where a page of any site asks
};

struct Refusal {
  int status = 400;  ///< of HTTP
  std::string_view text;
};

/// Why the request is refused; nullopt when it is not.
[[nodiscard]] std::optional<Refusal> refuse_request(const RequestHead& head, const OwnNames& own);

}  // namespace swiftlet
