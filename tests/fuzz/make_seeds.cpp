// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Writes the seeds of the fuzz targets: make_seeds FOLDER.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_link/capture/capture_writer.hpp"
#include "firmware_link/input/link_sample_source.hpp"
#include "firmware_link/link/frame_sink.hpp"
#include "firmware_link/sample_table/sample_table.hpp"
#include "swiftlet/command_t.hpp"
#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"
#include "tests/fuzz/fuzz_bytes.hpp"

namespace swiftlet {
namespace {

/// Keeps what it takes.
class FrameKeeper final : public FrameSink {
 public:
  std::vector<LinkFrame> frames;
  void take(const LinkFrame& frame) noexcept override { frames.push_back(frame); }
};

/// A handshake and a second of flight; without `left_out`, if there is such a variable.
std::vector<LinkFrame> session(std::string_view left_out) {
  FrameKeeper keeper;
  auto link = std::make_unique<ScriptedLink>();
  for (const ScriptedVehicle::Variable& variable : ScriptedVehicle::modern_variables())
    if (variable.group + '.' + variable.name != left_out) link->vehicle.variables.push_back(variable);
  link->last_ms = 1000;
  LinkInput input;
  input.name = "seed";
  input.starts_logging = true;
  input.recording = &keeper;
  input.link = std::move(link);
  LinkSampleSource source(std::move(input));
  for (;;) {
    const Result<ReceivedSample> received = source.next();
    if (!received && received.error().code != ErrorCode::kTimeout) return keeper.frames;
  }
}

/// A session of the compressed variables, as other clients log them.
std::vector<LinkFrame> compressed_session() {
  std::vector<LinkFrame> frames;
  std::int64_t at_ms = 0;
  const auto exchange = [&](const Bytes& request, const Bytes& reply) {
    frames.push_back(sent(request, host_ms(at_ms)));
    frames.push_back(received(reply, host_ms(++at_ms)));
  };
  exchange(hex("5c 03"), hex("50 03 04 00 01 02 03 04 10 80"));
  exchange(hex("5c 02 00 00"), toc_item_reply(0, LogType::kInt16, "stateEstimateZ", "x"));
  exchange(hex("5c 02 01 00"), toc_item_reply(1, LogType::kInt16, "stateEstimateZ", "y"));
  exchange(hex("5c 02 02 00"), toc_item_reply(2, LogType::kUint32, "stateEstimateZ", "quat"));
  exchange(hex("5c 02 03 00"), toc_item_reply(3, LogType::kUint16, "range", "front"));
  exchange(hex("5d 06 01 55 00 00 55 01 00 33 02 00 22 03 00"), hex("5d 06 01 00"));
  exchange(hex("5d 03 01 0a"), hex("5d 03 01 00"));
  for (std::uint32_t i = 1; i <= 8; ++i) {
    at_ms += 100;
    const LogPacket packet = LogPacket(1, 100 * i).i16(32760).i16(-5).u32(0xC0000000U + i).u16(1000);
    frames.push_back(received(packet.bytes(), host_ms(at_ms)));
  }
  return frames;
}

bool write(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file.good();
}
bool write(const std::filesystem::path& path, std::string_view text) {
  return write(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}
bool write(const std::filesystem::path& path, const std::vector<LinkFrame>& frames, CaptureLinkKind kind) {
  std::filesystem::create_directories(path.parent_path());
  CaptureVehicle vehicle;
  vehicle.kind = kind;
  vehicle.address.fill(0xE7);
  std::filesystem::remove(path);
  Result<CaptureWriter> writer = CaptureWriter::create(path.string(), vehicle);
  if (!writer) return false;
  for (const LinkFrame& frame : frames)
    if (!writer->write(frame)) return false;
  return writer->flush().ok();
}

bool write_uris(const std::filesystem::path& folder) {
  int number = 0;
  for (const std::string_view uri :
       {"radio://0/80/2M/E7E7E7E7E7?safelink=0&rate_limit=100", "radio://E7E7E7E7E7/125/250k/1", "radio://*",
        "usb://0", "udp://127.0.0.1:19850", "udp://[::1]:1", "sim://office?seed=7", "replay:flight.pcap"})
    if (!write(folder / std::to_string(number++), uri)) return false;
  return true;
}

/// See MoodyLink: which variable is left out, right answers, then log data of the blocks in turn.
bool write_handshakes(const std::filesystem::path& folder) {
  std::vector<std::uint8_t> two_blocks(80, 0x00);
  for (std::uint8_t i = 0; i < 40; ++i) two_blocks.insert(two_blocks.end(), {0x90, i});
  std::vector<std::uint8_t> one_block = two_blocks;
  one_block[0] = 0xFF;
  std::vector<std::uint8_t> half_deaf = one_block;
  for (std::size_t i = 1; i < 80; i += 3) half_deaf[i] = 0xE0;
  return write(folder / "one_block", one_block) && write(folder / "two_blocks", two_blocks) &&
         write(folder / "half_deaf", half_deaf);
}

/// A client that connects, logs and steers while the owner does the first steps of its handshake.
std::vector<std::uint8_t> shared_traffic() {
  struct Step {
    std::uint8_t whose;  ///< see client_traffic_fuzz.cpp
    LinkFrame frame;
  };
  const auto clients = [](const CrtpPacket& packet) {
    return Step{0x00, sent({packet.begin(), packet.end()})};
  };
  CrtpPacket create = log_block_request(LogCommand::kCreate, 1);
  static_cast<void>(add_log_entry(create, 7, 0));
  std::vector<std::uint8_t> bytes;
  for (const Step& step : {Step{0x80, sent(hex("5d 05"))}, Step{0x80, received(hex("5d 05 00 00"))},
                           clients(log_reset_request()), clients(toc_info_request(kLogTocTopic)),
                           Step{0x80, received(hex("50 03 8b 01 8c a1 4c 71 10 80"))}, clients(create),
                           Step{0x80, received(hex("5d 06 11 00"))}, clients(make_crtp_packet({7, 0}, {0})),
                           Step{0x80, received(hex("52 11 01 02 03 00 00 80 3f"))},
                           clients(log_reset_request()), Step{0x80, received(hex("5d 02 11 00"))}}) {
    bytes.push_back(step.whose);
    const std::vector<std::uint8_t> frame = as_fuzz_bytes({&step.frame, 1});
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  return bytes;
}

constexpr std::string_view kDescription = R"([[block]]
id = 1
period_ms = 100
variables = [
  { name = "stateEstimate.x", type = "float" },
  { name = "stateEstimate.y", type = "float" },
  { name = "stateEstimate.yaw", type = "half" },
  { name = "range.front", type = "uint16" },
]
)";
constexpr std::string_view kTruth =
    "# stamp x y z qx qy qz qw\n1627252327.515387 0.78 -0.27 0 0 0 -0.6 0.8\n1627252328 1 0 0 0 0 0 1\n";
constexpr std::string_view kRelations =
    "90.239599 90.719599 0.42 0 0 0 0 0.01\n90.719599 90.239599 -0.42 0 0 0 0 0\n";
/// May be either.
constexpr std::string_view kRelationsOrTruth = "1 2 0.5 0 0 0 0 1\n2 1 0 0 0 0 0 1\n";
/// What cfclient saves.
constexpr std::string_view kClientTable =
    "Timestamp,stateEstimate.x,stateEstimate.y,stabilizer.yaw,range.front,range.left,range.back,range.right\n"
    "15000,0,0.25,90,2000,700,32766,0\n"
    "15100,0.05,0.25,90,1950,700,32766,0\n"
    "15200,0.1,0.25,90,1900,700,32766,0\n";
/// Two samples with each kind of range.
std::string sample_table() {
  RangeSample sample;
  sample.starts_segment = true;
  sample.T_odom_body = Pose2(1.0, -2.0, 0.5);
  sample.beam_count = 4;
  sample.distance_m = {1.5F};
  sample.status = {RangeStatus::kHit, RangeStatus::kNoReturn, RangeStatus::kInvalid, RangeStatus::kNoReturn};
  std::string text =
      sample_table_head({.beams = BeamLayout::multiranger(), .sensor = SensorModel::crazyflie()});
  StoreyId storey{};
  append_sample_row(text, sample, storey);
  sample.starts_segment = false;
  sample.measured_at += std::chrono::milliseconds(100);
  sample.storey = make_id<StoreyId>(1);
  append_sample_row(text, sample, storey);
  return text;
}

/// Two scans of the smallest known width.
std::string laser_log() {
  std::string log = "PARAM robot_frontlaser_offset 0.0\n";
  for (const std::string_view pose : {"0.0 0.0 0.0", "0.1 0.0 0.1"}) {
    log += "FLASER 180";
    for (int i = 0; i < 180; ++i) log += i % 9 == 0 ? " 81.9" : " 2.5";
    for (int i = 0; i < 2; ++i) log.append(" ").append(pose);
    log += " 1.0 host 1.0\n";
  }
  return log;
}

constexpr std::string_view kPageRequest =
    "GET /view.js?1 HTTP/1.1\r\nHost: 127.0.0.1:8440\r\nOrigin: http://127.0.0.1:8440\r\nConnection: "
    "close\r\n\r\n";
constexpr std::string_view kSocketRequest =
    "GET /live HTTP/1.1\r\nHost: [::1]:8440\r\nOrigin: file://\r\nUpgrade: websocket\r\n"
    "Connection: keep-alive, Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    "Sec-WebSocket-Version: 13\r\n";
/// See web_request_fuzz.cpp; the first character chooses.
constexpr std::string_view kRequestLines = "0GET\n127.0.0.1:8440\n/view.js?1\n\nhttp://127.0.0.1:8440";
constexpr std::string_view kSocketLines =
    "1GET\n[::1]:8440\n/live\nfoxglove.sdk.v1, other\nhttps://app.foxglove.dev";
/// A WebSocket is asked for, then a text of the mask 0 arrives.
std::string socket_conversation(std::string_view more_header, std::string_view text) {
  std::string bytes(kSocketRequest);
  bytes.append(more_header).append("\r\n");
  bytes += {static_cast<char>(0x81), static_cast<char>(0x80U | text.size()), 0, 0, 0, 0};
  return bytes.append(text);
}
/// The first character chooses: of a run, of a recording.
constexpr std::string_view kPageLines = "0{\"at\": 2000000}\n{\"at\": null}\n{\"at\": -1.5e3}";
constexpr std::string_view kFoxgloveLines =
    "1{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":7,\"channelId\":4},{\"id\":8,\"channelId\":1}]}\n"
    "{\"op\":\"unsubscribe\",\"subscriptionIds\":[7]}\n"
    "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":7,\"channelId\":9},{\"id\":9,\"channelId\":7}]}";

/// As command_client_fuzz.cpp has it: LCM's greeting, then a place to mark.
std::vector<std::uint8_t> command_client() {
  std::vector<std::uint8_t> bytes{64, 0x28, 0x76, 0x17, 0xFB, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 16};
  for (const char letter : std::string_view("SWIFTLET_COMMAND"))
    bytes.push_back(static_cast<std::uint8_t>(letter));
  command_t command;
  command.action = command_t::ACTION_MARK_PLACE;
  command.name = "kitchen";
  const auto size = static_cast<std::size_t>(command.getEncodedSize());
  bytes.insert(bytes.end(), {0, 0, 0, static_cast<std::uint8_t>(size)});
  const std::size_t at = bytes.size();
  bytes.resize(at + size);
  command.encode(bytes.data() + at, 0, static_cast<int>(size));
  return bytes;
}

/// As published_messages_fuzz.cpp has it.
template <typename Message>
void append_message(std::vector<std::uint8_t>& bytes, std::uint8_t channel, Message message) {
  message.map_id = 5;
  const auto size = static_cast<std::size_t>(message.getEncodedSize());
  bytes.insert(bytes.end(),
               {channel, static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8U)});
  bytes.resize(bytes.size() + size);
  message.encode(bytes.data() + bytes.size() - size, 0, static_cast<int>(size));
}

/// One message of each channel, in the order of viewed_channels().
std::vector<std::uint8_t> published_messages() {
  std::vector<std::uint8_t> bytes;
  for (const std::uint8_t frame : {pose_t::FRAME_MAP, pose_t::FRAME_LOCAL, pose_t::FRAME_ODOM}) {
    pose_t pose{};
    pose.frame = static_cast<std::int8_t>(frame);
    pose.x = 1.0;
    append_message(bytes, frame, pose);
  }
  ranges_t ranges{};
  ranges.count = 2;
  ranges.bearing = {0.0F, 1.5F};
  ranges.distance = {1.25F, 0.0F};
  ranges.status = {ranges_t::STATUS_HIT, ranges_t::STATUS_NO_RETURN};
  append_message(bytes, 3, ranges);
  map_tile_t tile{};
  tile.version = 1;
  tile.resolution = 0.05;
  append_message(bytes, 4, tile);
  landmarks_t walls{};
  walls.total = walls.count = 1;
  walls.landmarks.push_back({.id = 1, .storey = 0, .start = {0, 0}, .end = {1, 0}});
  append_message(bytes, 5, walls);
  append_message(bytes, 6, loop_closure_t{});
  append_message(bytes, 7, vehicle_event_t{.utime = 0, .map_id = 0, .text = "land"});
  status_t status{};
  status.queue_count = 1;
  status.queues.resize(1);
  status.queues[0].name = "samples";
  status.stage_count = 1;
  status.stages.resize(1);
  status.stages[0].name = "frame_to_pose";
  append_message(bytes, 8, status);
  return bytes;
}

bool write_view(const std::filesystem::path& folder) {
  return write(folder / "web_request/page", kRequestLines) &&
         write(folder / "web_request/socket", kSocketLines) &&
         write(folder / "web_connection/page", kPageRequest) &&
         write(folder / "web_connection/live", socket_conversation("", "{\"at\": null}")) &&
         write(folder / "web_connection/foxglove",
               socket_conversation("Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n",
                                   R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":2}]})")) &&
         write(folder / "command_client/place", command_client()) &&
         write(folder / "page_client/lines", kPageLines) &&
         write(folder / "foxglove_client/lines", kFoxgloveLines) &&
         write(folder / "published_messages/run", published_messages());
}

bool write_all(const std::filesystem::path& folder) {
  const std::vector<LinkFrame> one_block = session("");
  const std::vector<LinkFrame> two_blocks = session("stateEstimate.x");
  return write(folder / "client_traffic/flight", shared_traffic()) && write_uris(folder / "input_uri") &&
         write_handshakes(folder / "log_handshake") &&
         write(folder / "log_session/one_block", as_fuzz_bytes(one_block)) &&
         write(folder / "log_session/two_blocks", as_fuzz_bytes(two_blocks)) &&
         write(folder / "log_session/compressed", as_fuzz_bytes(compressed_session())) &&
         write(folder / "recording/radio.pcap", one_block, CaptureLinkKind::kRadio) &&
         write(folder / "recording/usb.pcap", two_blocks, CaptureLinkKind::kUsb) &&
         write(folder / "recording/laser.clf", laser_log()) &&
         write(folder / "recording/samples.csv", sample_table()) &&
         write(folder / "recording/client.csv", kClientTable) && write(folder / "reference/truth", kTruth) &&
         write(folder / "reference/relations", kRelations) &&
         write(folder / "reference/either", kRelationsOrTruth) &&
         write(folder / "block_description/one.toml", kDescription) && write_view(folder);
}

}  // namespace
}  // namespace swiftlet

int main(int argc, char** argv) {
  if (argc == 2 && swiftlet::write_all(argv[1])) return 0;
  std::fprintf(stderr, "make_seeds FOLDER: writes the seeds there; is it writable?\n");
  return 2;
}
