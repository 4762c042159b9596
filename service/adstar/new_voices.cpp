#include "service/adstar/new_voices.hpp"

#include <algorithm>
#include <cstdlib>

#include "service/dds/convert.hpp"

namespace adstar::cli {

void NewVoices::hear(const adstar_ServiceStatus& status, std::int64_t received_ns) {
  // Whoever could write to the domain could otherwise fill our memory.
  constexpr std::size_t kMostKnown = 100'000;
  if (known_.size() < kMostKnown &&
      known_.emplace(status.instance_high, status.instance_low, status.run).second) {
    begun_[std::string(dds::text_of(status.service))].push_back({known_.size(), received_ns});
  }
}

std::optional<std::uint64_t> NewVoices::next(std::string_view service, std::uint64_t after,
                                             const Span& span,
                                             std::int64_t listened_since_ns) const {
  // A status is said once a second, and whoever begins to listen finds the topics one after the other.
  constexpr std::int64_t kAtOnce_ns = 3'000'000'000;
  const auto of_service = begun_.find(service);
  if (of_service == begun_.end()) {
    return std::nullopt;
  }
  const auto& begun = of_service->second;
  const bool was_there = std::abs(begun.front().received_ns - listened_since_ns) <= kAtOnce_ns;
  const auto found =
      std::find_if(begun.begin() + (was_there ? 1 : 0), begun.end(), [&](const Beginning& b) {
        return b.number > after && span.from_ns <= b.received_ns && b.received_ns <= span.to_ns;
      });
  return found == begun.end() ? std::nullopt : std::optional(found->number);
}

}  // namespace adstar::cli
