#include "service/adstar/chosen_service.hpp"

#include <set>

#include <fmt/format.h>

#include "service/adstar/dds_options.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/services.hpp"
#include "service/adstar/stop_signal.hpp"
#include "service/dds/wait_set.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Time for a second service to be heard of.
constexpr auto kSettle = 200ms;

std::set<std::string> names_of(const Services& services) {
  std::set<std::string> names;
  for (const ListedService* service : services.all()) {
    names.insert(service->name);
  }
  return names;
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "'" : ", '") + name + "'";
  }
  return text;
}

}  // namespace

std::string chosen_service(const dds::Participant& participant, const std::string& named,
                           std::chrono::nanoseconds timeout) {
  if (!named.empty()) {
    return named;
  }
  Services services(participant);
  dds::WaitSet wait_set(participant);
  services.attach_to(wait_set);
  auto until = Clock::now() + timeout;
  bool any = false;
  for (auto now = Clock::now(); now < until && !stop_requested(); now = Clock::now()) {
    wait_set.wait(std::min<Clock::duration>(until - now, 50ms));
    services.take();
    if (!any && !services.empty()) {
      any = true;
      until = std::min(until, Clock::now() + kSettle);
    }
  }
  const std::set<std::string> names = names_of(services);
  if (names.empty()) {
    throw Failure(
        kNoAnswer,
        fmt::format("no service answers within {} on {}; is adstard running, and are "
                    "domain, interface and partition those of its scene?",
                    scene::format_duration(timeout.count()), place_of(participant.options())));
  }
  if (names.size() > 1) {
    throw Failure(kUsage, fmt::format("several services are on the bus: {}; choose with --service",
                                      listed(names)));
  }
  return *names.begin();
}

}  // namespace adstar::cli
