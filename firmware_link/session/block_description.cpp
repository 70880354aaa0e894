// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/block_description.hpp"

#include <toml++/toml.h>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

/// Reads one file; keeps its name for messages.
class DescriptionParser {
 public:
  explicit DescriptionParser(std::string path) : path_(std::move(path)) {}

  Result<BlockDescription> parse(const toml::table& root) {
    BlockDescription description;
    description.source = path_;
    for (const auto& [key, value] : root)
      if (key.str() != "block") return fail(value, "unknown key '" + std::string(key.str()) + "'");
    const toml::array* blocks = root["block"].as_array();
    if (blocks == nullptr || blocks->empty()) return fail(root, "no [[block]]");
    for (const toml::node& node : *blocks) {
      const toml::table* table = node.as_table();
      if (table == nullptr) return fail(node, "block is not a table; write [[block]]");
      const Status added = add_block(*table, description);
      if (!added) return added.error();
    }
    return description;
  }

 private:
  Error fail(const toml::node& where, const std::string& what) const {
    return {ErrorCode::kInvalidInput, path_ + ":" + std::to_string(where.source().begin.line) + ": " + what};
  }

  Status add_block(const toml::table& table, BlockDescription& description) const {
    for (const auto& [key, value] : table)
      if (key.str() != "id" && key.str() != "period_ms" && key.str() != "variables")
        return fail(value, "unknown key '" + std::string(key.str()) + "'");
    const std::optional<std::int64_t> id = table["id"].value_exact<std::int64_t>();
    if (!id || *id < 0 || *id > 255) return fail(table, "a block needs an id from 0 to 255");
    const auto block_id = static_cast<std::uint8_t>(*id);
    if (description.blocks.contains(block_id)) return fail(table, "block " + std::to_string(*id) + " twice");

    BlockDescription::Block block;
    if (const toml::node* period = table.get("period_ms")) {
      const std::optional<std::int64_t> period_ms = period->value_exact<std::int64_t>();
      if (!period_ms || *period_ms < 1 || *period_ms > 65535)
        return fail(*period, "period_ms must be a whole number from 1 to 65535");
      block.period = std::chrono::milliseconds(*period_ms);
    }
    Status read = read_variables(table, block.variables);
    if (!read) return read;
    description.blocks.emplace(block_id, std::move(block));
    return {};
  }

  Status read_variables(const toml::table& table, std::vector<BlockDescription::Variable>& variables) const {
    const toml::array* list = table["variables"].as_array();
    if (list == nullptr || list->empty()) return fail(table, "a block needs variables = [ ... ]");
    std::size_t bytes = 0;
    for (const toml::node& node : *list) {
      const toml::table* entry = node.as_table();
      if (entry == nullptr || entry->size() != 2)
        return fail(node, "write { name = \"...\", type = \"...\" }");
      const std::optional<std::string_view> name = (*entry)["name"].value<std::string_view>();
      const std::optional<std::string_view> type_name = (*entry)["type"].value<std::string_view>();
      if (!name || name->empty() || !type_name) return fail(node, "write { name = \"...\", type = \"...\" }");
      const std::optional<LogType> type = log_type_named(*type_name);
      if (!type) return fail(node, "no type '" + std::string(*type_name) + "'");
      bytes += size_of(*type);
      if (bytes > kMaxLogBytes) return fail(node, "more than 26 bytes in one block");
      variables.push_back({std::string(*name), *type});
    }
    return {};
  }

  std::string path_;
};

}  // namespace

Result<BlockDescription> read_block_description(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    return Error{ErrorCode::kNotFound, path + ": no such file"};
  try {
    return DescriptionParser(path).parse(toml::parse_file(path));
  } catch (const toml::parse_error& error) {
    return Error{ErrorCode::kInvalidInput, path + ":" + std::to_string(error.source().begin.line) + ": " +
                                               std::string(error.description())};
  }
}

}  // namespace swiftlet
