// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/web_answer.hpp"

namespace swiftlet {

WebAnswer answer_request(const WebRequest& request, const PageFiles& files, const OwnNames& own) {
  if (const std::optional<Refusal> refusal = refuse_request(request.head, own))
    return {.status = refusal->status, .file = {"text/plain", refusal->text}};
  const std::string_view path = request.target.substr(0, request.target.find('?'));
  if (request.wants_socket)
    return {.file = {}, .socket = SocketRequest{.path = path, .subprotocols = request.subprotocols}};
  const auto file = files.find(path);
  if (file == files.end())
    return {
        .status = 404, .file = {"text/plain", "there is no such page\n"}, .keeps_alive = request.keeps_alive};
  return {.file = file->second, .keeps_alive = request.keeps_alive};
}

}  // namespace swiftlet
