#include "service/adstar/new_voices.hpp"

#include <algorithm>

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
                                             std::int64_t from_ns, std::int64_t to_ns) const {
  const auto of_service = begun_.find(service);
  if (of_service == begun_.end()) {
    return std::nullopt;
  }
  const auto& begun = of_service->second;
  const auto found = std::find_if(begun.begin() + 1, begun.end(), [&](const Beginning& b) {
    return b.number > after && from_ns <= b.received_ns && b.received_ns <= to_ns;
  });
  return found == begun.end() ? std::nullopt : std::optional(found->number);
}

}  // namespace adstar::cli
