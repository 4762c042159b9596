#include "service/bridge/options.hpp"

#include <charconv>
#include <string_view>

#include <CLI/CLI.hpp>

namespace adstar::bridge {
namespace {

bool parse_hex(std::string_view digits, std::uint64_t& value) {
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return error == std::errc() && end == digits.data() + digits.size();
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  std::string instance;
  CLI::App app("the DDS side of adstard");
  app.set_help_flag();
  app.add_option("--segment-fd", options.segment_fd)->required();
  app.add_option("--scene-fd", options.scene_fd)->required();
  app.add_option("--scene-file", options.scene_file)->required();
  app.add_option("--service", options.service)->required();
  app.add_option("--instance", instance)->required();
  app.add_option("--started-utc-ns", options.started_utc_ns)->required();
  app.add_option("--run", options.run);
  app.add_flag("--standby", options.standby);
  app.add_option("--parent", options.parent)->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Error&) {
    return std::nullopt;
  }
  const std::string_view digits = instance;
  if (digits.size() != 32 || !parse_hex(digits.substr(0, 16), options.instance.high) ||
      !parse_hex(digits.substr(16), options.instance.low)) {
    return std::nullopt;
  }
  return options;
}

}  // namespace adstar::bridge
