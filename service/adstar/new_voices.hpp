#pragma once
// When somebody began to fly as a service who had not been heard before: a daemon's process and its run, as
// ServiceStatus names them. A standby is known before it takes over; a primary that had hung is known when it
// comes back.

#include <cstdint>
#include <health.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace adstar::cli {

class NewVoices {
 public:
  void hear(const adstar_ServiceStatus& status, std::int64_t received_ns);

  /// Whether anybody was first heard as that service.
  bool know(std::string_view service) const { return begun_.contains(service); }
  struct Span {
    std::int64_t from_ns, to_ns;  ///< of reception
  };
  /// The number, of all services and from 1 on, of the first after `after` who was first heard as `service` in this span.
  /// Not of the very first one as that service where it was heard within 3 s of `listened_since_ns`: it may have
  /// flown long before.
  std::optional<std::uint64_t> next(std::string_view service, std::uint64_t after, const Span& span,
                                    std::int64_t listened_since_ns) const;

 private:
  struct Beginning {
    std::uint64_t number;
    std::int64_t received_ns;
  };
  std::set<std::tuple<std::uint64_t, std::uint64_t, std::uint32_t>> known_;  ///< instance and run
  std::map<std::string, std::vector<Beginning>, std::less<>> begun_;         ///< by service
};

}  // namespace adstar::cli
