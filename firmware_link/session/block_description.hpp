// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "firmware_link/crtp/log_value.hpp"

namespace swiftlet {

/// A description of log blocks, written by hand, for captures without a table of contents (client programs
/// keep the table in a cache and then do not request it). It lies beside the capture as FILE.pcap.toml:
///
/// [[block]] id = 1 # block id, 0..255 period_ms = 100 # optional variables = [ # in the order in which the
/// block was created { name = "stateEstimate.x", type = "float" }, { name = "range.front", type = "uint16" },
/// ]
///
/// Types: uint8, uint16, uint32, int8, int16, int32, float, half (as fetched); at most 26 bytes a block.
struct BlockDescription {
  struct Variable {
    std::string name;
    LogType type = LogType::kUint8;
  };
  struct Block {
    Duration period{0};  ///< 0: not given, and learnt from the packets
    std::vector<Variable> variables;
  };
  std::string source;  ///< the file it was read from; empty: none
  std::map<std::uint8_t, Block> blocks;
};

/// Errors: kNotFound: no such file. kInvalidInput: not TOML, or not the format above; names file and line.
[[nodiscard]] Result<BlockDescription> read_block_description(const std::string& path);

}  // namespace swiftlet
