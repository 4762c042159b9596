#include "service/dds/log_sink.hpp"

#include <cstdint>
#include <exception>
#include <string_view>

#include <dds/ddsrt/log.h>
#include <spdlog/spdlog.h>

#include "service/dds/rate_limit.hpp"

namespace adstar::dds {
namespace {

constexpr std::uint32_t kLinesPerSecond = 10;

void write_line(void* /*unused*/, const dds_log_data_t* data) {
  static RateLimit limit(kLinesPerSecond);
  try {
    const auto dropped = limit.admit();
    if (!dropped) {
      return;
    }
    if (*dropped > 0) {
      spdlog::warn("dds: {} more lines dropped", *dropped);
    }
    std::string_view line(data->message);
    while (!line.empty() && line.back() == '\n') {
      line.remove_suffix(1);
    }
    const bool error = (data->priority & (DDS_LC_ERROR | DDS_LC_FATAL)) != 0;
    const bool warning = (data->priority & DDS_LC_WARNING) != 0;
    spdlog::log(error     ? spdlog::level::err
                : warning ? spdlog::level::warn
                          : spdlog::level::debug,
                "dds: {}", line);
  } catch (const std::exception&) {
    // Called from C: nothing may pass through.
  }
}

}  // namespace

void install_log_sink() {
  dds_set_log_sink(&write_line, nullptr);
  dds_set_trace_sink(&write_line, nullptr);
}

}  // namespace adstar::dds
