// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "daemon/publish/lcm_transport.hpp"
#include "daemon/publish/publisher.hpp"

namespace swiftlet {

/// Takes an encoded message, which is valid during the call. False, with errno: it is lost.
using MessageSink = std::function<bool(const std::string& channel, std::span<const std::uint8_t> message)>;

/// The most that one datagram carries; LCM would cut larger messages into fragments.
inline constexpr std::size_t kMaxLcmMessageBytes = 65'499;
inline constexpr std::size_t kMaxWallsPerMessage = 1000;

/// Whose messages are published besides swiftlet's own.
enum class Compatibility : std::uint8_t {
  kNone,
  kMbot,  ///< as make_mbot_publisher()
};

/// Publishes over `lcm`, which must outlive the publisher, with the types in proto/; docs/lcm.md lists the
/// channels. Every message fits one datagram. `map_id` names the run. A message that LCM does not take is
/// lost; the first one is logged. `also`, where it is set, is given each message of swiftlet's own after LCM,
/// whether LCM took it or not.
[[nodiscard]] std::unique_ptr<Publisher> make_lcm_publisher(LcmTransport& lcm,
                                                            const std::string& channel_prefix,
                                                            std::int64_t map_id, MessageSink also = {},
                                                            Compatibility compatibility = {});

/// The same messages for `sink`, without LCM.
[[nodiscard]] std::unique_ptr<Publisher> make_message_publisher(MessageSink sink,
                                                                const std::string& channel_prefix,
                                                                std::int64_t map_id);

}  // namespace swiftlet
