// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/input_uri.hpp"

#include <algorithm>
#include <vector>

#include "firmware_link/link/uri_text.hpp"

namespace swiftlet {
namespace {

Error invalid(const std::string& uri, const std::string& what) {
  return {ErrorCode::kInvalidInput, "input '" + uri + "': " + what};
}

Error no_scheme(const std::string& uri, const std::string& what) {
  using enum InputNature;
  return invalid(uri, what + "; swiftlet takes " + input_forms({kVehicle, kSimulation, kFile}));
}

Status parse_as(const InputKind& kind, const std::string& uri, std::any& address) {
  if (uri.starts_with(kind.scheme))
    return kind.parse(std::string_view(uri).substr(kind.scheme.size()), address);
  return bad_address("two slashes follow " + in_quotes(kind.scheme.substr(0, kind.scheme.find(':') + 1)));
}

const InputKind& file_kind() {
  return *std::ranges::find(input_kinds(), InputNature::kFile, &InputKind::nature);
}

}  // namespace

std::string input_forms(std::initializer_list<InputNature> natures) {
  std::vector<std::string> forms;
  for (const InputKind& kind : input_kinds()) {
    if (std::ranges::find(natures, kind.nature) == natures.end()) continue;
    forms.push_back(std::string(kind.scheme).append(kind.form));
    if (kind.nature == InputNature::kFile) forms.emplace_back("a path (.pcap, .csv or .clf, also in gzip)");
  }
  std::string text;
  for (const std::string& form : forms) {
    if (!text.empty()) text += &form == &forms.back() ? " or " : ", ";
    text += form;
  }
  return text;
}

Result<InputUri> parse_input_uri(const std::string& uri) {
  if (uri.empty()) return no_scheme(uri, "is empty");
  for (const InputKind& kind : input_kinds()) {
    if (!uri.starts_with(kind.scheme.substr(0, kind.scheme.find(':') + 1))) continue;
    InputUri parsed{.kind = &kind, .address = {}};
    if (const Status status = parse_as(kind, uri, parsed.address); !status)
      return invalid(uri, status.error().message + "; example: " + std::string(kind.example));
    return parsed;
  }
  if (uri.find("://") != std::string::npos)
    return no_scheme(uri, "unknown scheme " + in_quotes(uri.substr(0, uri.find(':'))));
  return InputUri{.kind = &file_kind(), .address = InputFile{uri}};
}

std::string file_of_input(const std::string& uri) {
  const Result<InputUri> parsed = parse_input_uri(uri);
  const auto* const file = parsed ? parsed->as<InputFile>() : nullptr;
  return file != nullptr ? file->path : "";
}

}  // namespace swiftlet
