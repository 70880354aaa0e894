// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/web_answer.hpp"

#include <vector>

namespace swiftlet {
namespace {

constexpr std::string_view kSpace = " \t";

std::string_view without_space(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> items_of(std::string_view list) {
  std::vector<std::string_view> items;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = list.find(',');
    if (const std::string_view item = without_space(list.substr(0, comma)); !item.empty())
      items.push_back(item);
    if (comma != std::string_view::npos) list.remove_prefix(comma + 1);
  }
  return items;
}

}  // namespace

WebAnswer answer_request(const WebRequest& request, const PageFiles& files, const OwnNames& own) {
  if (const std::optional<Refusal> refusal = refuse_request(request.head, own))
    return {.status = refusal->status, .file = {"text/plain", refusal->text}};
  const std::string_view path = request.target.substr(0, request.target.find('?'));
  if (request.wants_socket)
    return {.file = {},
            .socket = SocketRequest{.path = path, .subprotocols = items_of(request.subprotocols)}};
  const auto file = files.find(path);
  if (file == files.end())
    return {
        .status = 404, .file = {"text/plain", "there is no such page\n"}, .keeps_alive = request.keeps_alive};
  return {.file = file->second, .keeps_alive = request.keeps_alive};
}

}  // namespace swiftlet
