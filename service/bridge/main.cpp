// adstar-bridge: the DDS side of adstard, in a process of its own so that it can fall alone.

#include <cstdio>
#include <exception>
#include <string>
#include <sys/prctl.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/bridge/bridge.hpp"
#include "service/bridge/options.hpp"
#include "service/bridge/process.hpp"
#include "service/dds/error.hpp"
#include "service/log.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace {

using namespace adstar;

int attach_and_run(const bridge::Options& options) {
  runtime::MappedSegment segment = runtime::MappedSegment::attach(options.segment_fd);
  try {
    const scene::Scene scene =
        scene::parse(bridge::read_whole(options.scene_fd), options.scene_file, scene::Tables::skip);
    set_up_log(scene.log, "bridge");
    return bridge::run(options, scene, segment);
  } catch (const scene::SceneError& error) {
    spdlog::error("{}", error.what());
    bridge::refuse(*segment, error.what());
    return bridge::kUsage;
  } catch (const dds::Error& error) {
    // Before any bridge was ready this is a matter of configuration, which no restart cures.
    const auto ready = static_cast<std::uint32_t>(runtime::BridgeState::ready);
    spdlog::error("{}", error.what());
    if (segment->bridge_state.load() == ready) {
      return bridge::kFailed;
    }
    bridge::refuse(*segment, error.what());
    return bridge::kUsage;
  }
}

}  // namespace

int main(int argc, char** argv) {
  prctl(PR_SET_NAME, "adstar-bridge");  // adstard starts it by the number of a file
  const auto options = bridge::parse_options(argc, argv);
  if (!options) {
    std::fputs("adstar-bridge is started by adstard, never by hand; run: adstard scene.toml\n",
               stderr);
    return bridge::kUsage;
  }
  try {
    bridge::install_signal_handlers();
    if (!bridge::die_with_parent(options->parent)) {
      fmt::print(stderr, "adstar-bridge: process {} is not its parent; only adstard starts it\n",
                 options->parent);
      return bridge::kUsage;
    }
    return attach_and_run(*options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "adstar-bridge: {}\n", error.what());
    return bridge::kFailed;
  }
}
