// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = 1'000'000;  // before compression
constexpr int kCompressionLevel = 3;

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

/// Values as the format has them: little-endian, lengths before what has one.
class Fields {
 public:
  template <typename Number>
  Fields& number(Number value) {
    static_assert(std::is_unsigned_v<Number>);
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
    return *this;
  }
  /// With its length in 32 bits: a string, an array or a map.
  Fields& sized(std::string_view bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    return raw(bytes);
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, const Fields& fields) {
  Fields whole;
  whole.number(static_cast<std::uint8_t>(opcode)).number(std::uint64_t{fields.bytes().size()});
  return whole.raw(fields.bytes()).bytes();
}

std::uint32_t crc_of(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT
}

std::string schema_record(const McapChannel& channel) {
  return record(Opcode::kSchema, Fields()
                                     .number(channel.id)
                                     .sized(channel.schema_name)
                                     .sized(channel.schema_encoding)
                                     .sized(channel.schema));
}

std::string channel_record(const McapChannel& channel) {
  return record(Opcode::kChannel, Fields()
                                      .number(channel.id)
                                      .number(channel.id)
                                      .sized(channel.topic)
                                      .sized(channel.message_encoding)
                                      .sized(""));
}

/// The records of a chunk as they stand in the file.
struct PackedRecords {
  std::string_view compression;
  std::string bytes;
};

PackedRecords packed(const std::string& records) {
  std::string bytes(ZSTD_compressBound(records.size()), '\0');
  const std::size_t size =
      ZSTD_compress(bytes.data(), bytes.size(), records.data(), records.size(), kCompressionLevel);
  if (ZSTD_isError(size) != 0) return {.compression = "", .bytes = records};  // for want of memory alone
  bytes.resize(size);
  return {.compression = "zstd", .bytes = std::move(bytes)};
}

/// Records of one kind, beside each other.
struct Group {
  Opcode opcode{};
  std::string records;
};

}  // namespace

void McapWriter::Span::include(std::uint64_t time_ns) {
  first_ns = count == 0 ? time_ns : std::min(first_ns, time_ns);
  last_ns = std::max(last_ns, time_ns);
  ++count;
}

McapWriter::McapWriter(FileSink write, std::vector<McapChannel> channels)
    : write_(std::move(write)), channels_(std::move(channels)) {
  put(kMagic);
  put(record(Opcode::kHeader, Fields().sized("").sized("swiftlet")));
  for (const McapChannel& channel : channels_) put(schema_record(channel) + channel_record(channel));
}

void McapWriter::put(std::string_view bytes) {
  write_(bytes);
  offset_ += bytes.size();
  crc_ = crc_of(crc_, bytes);
}

void McapWriter::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message) {
  chunk_index_[channel].emplace_back(time_ns, chunk_.size());
  const auto sequence = static_cast<std::uint32_t>(message_counts_[channel]++);
  chunk_ += record(Opcode::kMessage,
                   Fields().number(channel).number(sequence).number(time_ns).number(time_ns).raw(message));
  chunk_span_.include(time_ns);
  messages_.include(time_ns);
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t size = chunk_.size();
  const PackedRecords records = packed(chunk_);
  const std::uint64_t packed_size = records.bytes.size();
  const std::uint64_t chunk_at = offset_;
  Fields chunk;
  chunk.number(chunk_span_.first_ns).number(chunk_span_.last_ns).number(size).number(crc_of(0, chunk_));
  put(record(Opcode::kChunk, chunk.sized(records.compression).number(packed_size).raw(records.bytes)));
  const std::uint64_t indices_at = offset_;
  Fields index_offsets;
  for (const auto& [channel, messages] : chunk_index_) {
    index_offsets.number(channel).number(offset_);
    Fields entries;
    for (const auto& [time_ns, at] : messages) entries.number(time_ns).number(at);
    put(record(Opcode::kMessageIndex, Fields().number(channel).sized(entries.bytes())));
  }
  Fields summary;
  summary.number(chunk_span_.first_ns).number(chunk_span_.last_ns);
  summary.number(chunk_at).number(indices_at - chunk_at).sized(index_offsets.bytes());
  summary.number(offset_ - indices_at).sized(records.compression).number(packed_size).number(size);
  chunk_indices_.push_back(record(Opcode::kChunkIndex, summary));
  chunk_.clear();
  chunk_span_ = {};
  chunk_index_.clear();
}

std::string McapWriter::statistics() const {
  Fields counts;
  for (const auto& [channel, count] : message_counts_) counts.number(channel).number(count);
  const auto channels = static_cast<std::uint32_t>(channels_.size());
  Fields statistics;
  statistics.number(messages_.count).number(static_cast<std::uint16_t>(channels)).number(channels);
  statistics.number(std::uint32_t{0}).number(std::uint32_t{0});  // attachments, metadata
  statistics.number(static_cast<std::uint32_t>(chunk_indices_.size()));
  statistics.number(messages_.first_ns).number(messages_.last_ns).sized(counts.bytes());
  return record(Opcode::kStatistics, statistics);
}

void McapWriter::finish() {
  end_chunk();
  put(record(Opcode::kDataEnd, Fields().number(crc_)));
  std::array<Group, 4> groups{Group{Opcode::kSchema, {}}, Group{Opcode::kChannel, {}},
                              Group{Opcode::kStatistics, statistics()}, Group{Opcode::kChunkIndex, {}}};
  for (const McapChannel& channel : channels_) {
    groups[0].records += schema_record(channel);
    groups[1].records += channel_record(channel);
  }
  for (const std::string& index : chunk_indices_) groups[3].records += index;
  const std::uint64_t summary_at = offset_;
  crc_ = 0;  // from here on that of the summary
  std::string offsets;
  for (const Group& group : groups) {
    if (!group.records.empty())
      offsets += record(Opcode::kSummaryOffset, Fields()
                                                    .number(static_cast<std::uint8_t>(group.opcode))
                                                    .number(offset_)
                                                    .number(std::uint64_t{group.records.size()}));
    put(group.records);
  }
  const std::uint64_t offsets_at = offset_;
  put(offsets);
  constexpr std::uint64_t kFooterBytes = 20;
  Fields head;
  head.number(static_cast<std::uint8_t>(Opcode::kFooter)).number(kFooterBytes);
  put(head.number(summary_at).number(offsets_at).bytes());
  put(Fields().number(crc_).raw(kMagic).bytes());
}

}  // namespace swiftlet
