#pragma once
// Who else flies what, on this domain and partition.

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "service/bridge/directory.hpp"
#include "service/bridge/options.hpp"
#include "service/dds/reader.hpp"

namespace adstar::bridge {

/// Another daemon claims one of our spacecraft.
struct Rival {
  std::string service;
  std::string spacecraft;
  bool older = false;  ///< it was there first, so it stays
};

class OtherServices {
 public:
  OtherServices(const dds::Participant& participant, const Directory& directory,
                const Options& options);

  /// Reads what came since; the first rival among it. An older one takes precedence. Main thread.
  std::optional<Rival> poll();

  /// From now on a daemon of our own name is no rival.
  void tolerate_namesakes() noexcept { tolerates_namesakes_ = true; }

  /// Some other daemon lists the spacecraft. Any thread.
  bool flies(std::string_view spacecraft) const;

 private:
  using Instance =
      std::tuple<std::int64_t, std::uint64_t, std::uint64_t>;  ///< start and random bits
  void learn(const adstar_ServiceRoster& roster, std::optional<Rival>& rival);
  void forget(const adstar_ServiceRoster& key);

  dds::Reader<adstar_ServiceRoster> reader_;
  const Directory& directory_;
  Instance self_;
  std::string service_;
  bool tolerates_namesakes_ = false;
  mutable std::mutex mutex_;
  std::map<Instance, std::unordered_set<std::string>> spacecraft_;
};

}  // namespace adstar::bridge
