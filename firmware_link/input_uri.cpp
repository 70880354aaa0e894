// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input_uri.hpp"

#include <charconv>
#include <string_view>

namespace swiftlet {
namespace {

constexpr std::string_view kForms = "; swiftlet takes replay:FILE, sim://WORLD?seed=N or a path";

Error invalid(const std::string& uri, const std::string& what) {
  return {ErrorCode::kInvalidInput, "input '" + uri + "': " + what};
}

Result<InputUri> parse_simulation(const std::string& uri, std::string_view rest) {
  InputUri parsed;
  parsed.kind = InputUri::Kind::kSimulation;
  const std::size_t question = rest.find('?');
  parsed.world = rest.substr(0, question);
  if (parsed.world.empty()) return invalid(uri, "names no world; write sim://office?seed=1");
  if (question == std::string_view::npos) return parsed;
  const std::string_view query = rest.substr(question + 1);
  constexpr std::string_view kSeed = "seed=";
  if (!query.starts_with(kSeed)) return invalid(uri, "the only parameter is seed, as in sim://office?seed=1");
  const char* end = query.data() + query.size();
  const auto [stop, error] = std::from_chars(query.data() + kSeed.size(), end, parsed.seed);
  if (error != std::errc{} || stop != end)
    return invalid(uri, "the seed must be a whole number from 0 to 18446744073709551615");
  return parsed;
}

}  // namespace

Result<InputUri> parse_input_uri(const std::string& uri) {
  constexpr std::string_view kReplay = "replay:";
  constexpr std::string_view kSimulation = "sim://";
  const std::string_view text(uri);
  if (text.empty()) return invalid(uri, "is empty" + std::string(kForms));
  if (text.starts_with(kSimulation)) return parse_simulation(uri, text.substr(kSimulation.size()));
  InputUri parsed;
  parsed.path = uri;
  if (text.starts_with(kReplay)) {
    parsed.path = text.substr(kReplay.size());
    if (parsed.path.empty()) return invalid(uri, "names no file; write replay:flight.pcap");
    return parsed;
  }
  const std::size_t scheme_end = text.find("://");
  if (scheme_end != std::string_view::npos || text.starts_with("sim:"))
    return invalid(uri, "unknown scheme '" + uri.substr(0, text.find(':')) + "'" + std::string(kForms));
  return parsed;
}

}  // namespace swiftlet
