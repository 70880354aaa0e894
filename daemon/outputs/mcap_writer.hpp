// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/outputs/file_writer.hpp"

namespace swiftlet {

/// What a message's topic is called and how its messages are encoded. Each has a schema of its own.
struct McapChannel {
  std::uint16_t id = 0;  ///< from 1
  std::string_view topic;
  std::string_view message_encoding;
  std::string_view schema_name;
  std::string_view schema_encoding;
  std::string_view schema;
};

/// Writes an MCAP file (https://mcap.dev/spec): messages in chunks, compressed by zstd, with indices,
/// summary, checksums. The same calls write the same bytes. One thread at a time.
class McapWriter {
 public:
  /// Begins the file. What the channels view must live until finish().
  McapWriter(FileSink write, std::vector<McapChannel> channels);

  /// `time_ns` since 1970; need not be in order. Precondition: `channel` is the id of one of the channels.
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message);
  /// The next message begins another chunk.
  void end_chunk();
  /// Ends the file. Call once, last.
  void finish();

  [[nodiscard]] std::uint64_t messages() const { return messages_.count; }

 private:
  struct Span {
    std::uint64_t count = 0;
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    void include(std::uint64_t time_ns);
  };
  using Index = std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;

  FileSink write_;
  std::vector<McapChannel> channels_;
  std::uint64_t offset_ = 0;  // in the file
  std::uint32_t crc_ = 0;     // of what was written
  Span messages_;
  std::map<std::uint16_t, std::uint64_t> message_counts_;
  std::string chunk_;  // its messages
  Span chunk_span_;
  Index chunk_index_;
  std::vector<std::string> chunk_indices_;  // for the summary

  void put(std::string_view bytes);
  [[nodiscard]] std::string statistics() const;
};

}  // namespace swiftlet
