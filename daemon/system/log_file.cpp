// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/log_file.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace swiftlet {
namespace {

Result<spdlog::sink_ptr> open_file(const std::string& path) {
  try {
    return spdlog::sink_ptr(std::make_shared<spdlog::sinks::basic_file_sink_mt>(path));
  } catch (const spdlog::spdlog_ex& error) {
    return Error{ErrorCode::kInvalidInput, "log file " + path + ": " + error.what()};
  }
}

}  // namespace

struct LogFile::State {
  std::string path;
  std::shared_ptr<spdlog::logger> before = spdlog::default_logger();
  std::shared_ptr<spdlog::sinks::dist_sink_mt> sink = std::make_shared<spdlog::sinks::dist_sink_mt>();
};

Result<std::unique_ptr<LogFile>> LogFile::open(const std::string& path) {
  Result<spdlog::sink_ptr> file = open_file(path);
  if (!file) return Error{file.error().code, file.error().message + "; name another file with --log-file"};
  auto state = std::make_unique<State>();
  state->path = path;
  state->sink->add_sink(std::move(file).value());
  auto logger = std::make_shared<spdlog::logger>("swiftletd", state->sink);
  logger->set_level(state->before->level());
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(std::move(logger));
  return std::unique_ptr<LogFile>(new LogFile(std::move(state)));
}

LogFile::LogFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
LogFile::~LogFile() { spdlog::set_default_logger(state_->before); }

void LogFile::reopen() {
  Result<spdlog::sink_ptr> file = open_file(state_->path);
  if (file) {
    state_->sink->set_sinks({std::move(file).value()});
    spdlog::info("log file reopened");
  } else {
    spdlog::error("{}; the log goes on where it was", file.error().message);
  }
}

}  // namespace swiftlet
