#include "service/log.hpp"

#include <memory>
#include <string>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace adstar {

void set_up_log(const scene::Log& log, std::string_view program) {
  spdlog::sink_ptr sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  std::string trouble;
  if (!log.file.empty()) {
    try {
      sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(log.file, /*truncate=*/false);
    } catch (const spdlog::spdlog_ex& error) {
      trouble = error.what();
    }
  }
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(std::string(program), sink));
  spdlog::set_pattern("%Y-%m-%d %H:%M:%S.%e %n %l: %v");
  spdlog::set_level(spdlog::level::from_str(log.level));
  spdlog::flush_on(spdlog::level::trace);
  if (!trouble.empty()) {
    spdlog::warn("cannot open [log] file '{}': {}; logging to stderr", log.file, trouble);
  }
}

}  // namespace adstar
