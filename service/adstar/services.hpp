#pragma once
// Who is on the bus: every daemon's roster and last status, put together.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/participant.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"

namespace adstar::cli {

/// Text off the network that may go to a terminal: nothing in it can command it.
std::string printable(std::string_view text);

struct ListedSpacecraft {
  std::string name;
  std::vector<std::string> actuators;
};

struct ListedService {
  std::string name;
  std::int64_t started_utc_ns = 0;
  std::optional<adstar_ServiceStatus> status;
  std::map<std::uint32_t, std::vector<ListedSpacecraft>> chunks;  ///< by the first one's index
  std::size_t chunks_expected = 1;

  bool roster_complete() const { return chunks.size() >= chunks_expected; }
  std::size_t size() const;
  /// By its index in the scene; null when its part of the roster has not come.
  const ListedSpacecraft* at(std::uint32_t index) const;
};

class Services {
 public:
  explicit Services(const dds::Participant& participant)
      : rosters_(participant), statuses_(participant) {}

  void attach_to(dds::WaitSet& wait_set) const {
    wait_set.attach(rosters_);
    wait_set.attach(statuses_);
  }

  /// Takes what has come; true when anything did.
  bool take();

  /// In the order of their names; those of one name by their start.
  std::vector<const ListedService*> all() const;
  /// The youngest of that name.
  const ListedService* named(std::string_view name) const;
  bool empty() const { return services_.empty(); }

 private:
  struct Key {
    std::string name;
    std::uint64_t high, low;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  void learn(const adstar_ServiceRoster& roster);
  void learn(const adstar_ServiceStatus& status);

  dds::Reader<adstar_ServiceRoster> rosters_;
  dds::Reader<adstar_ServiceStatus> statuses_;
  std::map<Key, ListedService> services_;
};

}  // namespace adstar::cli
