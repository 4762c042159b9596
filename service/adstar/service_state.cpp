#include "service/adstar/service_state.hpp"

#include <fmt/format.h>

namespace adstar::cli {

const char* state_text(adstar_ServiceState state) {
  switch (state) {
    case adstar_SERVICE_RUNNING:
      return "running";
    case adstar_SERVICE_STOPPED:
      return "stopped";
    case adstar_SERVICE_HALTED:
      return "HALTED (a beat was over its budget; see its log)";
    case adstar_SERVICE_WAITING:
      return "waiting for a step request";
    case adstar_SERVICE_PAUSED:
      return "paused";
    case adstar_SERVICE_STANDBY:
      return "a standby";
  }
  return "in a state that this program does not know";
}

const char* state_word(adstar_ServiceState state) {
  switch (state) {
    case adstar_SERVICE_RUNNING:
      return "running";
    case adstar_SERVICE_STOPPED:
      return "stopped";
    case adstar_SERVICE_HALTED:
      return "halted";
    case adstar_SERVICE_WAITING:
      return "waiting";
    case adstar_SERVICE_PAUSED:
      return "paused";
    case adstar_SERVICE_STANDBY:
      return "standby";
  }
  return "unknown";
}

std::string standing_clocks(const Services& services) {
  std::string text;
  for (const ListedService* service : services.all()) {
    if (service->status && service->status->state != adstar_SERVICE_RUNNING) {
      text += fmt::format("{}'{}' is {}", text.empty() ? "" : "; ", service->name,
                          state_text(service->status->state));
    }
  }
  return text;
}

}  // namespace adstar::cli
