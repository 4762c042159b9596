#pragma once
// Sleeps until one of several readers has something to take, or somebody calls wake().

#include <chrono>
#include <vector>

#include <dds/dds.h>

#include "service/dds/entity.hpp"
#include "service/dds/participant.hpp"

namespace adstar::dds {

/// Must be gone before its readers are.
class WaitSet {
 public:
  explicit WaitSet(const Participant& participant);

  /// A Reader of some topic, or a RawReader.
  template <class AnyReader>
  void attach(const AnyReader& reader) {
    attach_reader(reader.handle());
  }

  /// True when there is something to take or wake() was called; false after the timeout.
  bool wait(std::chrono::nanoseconds timeout);

  /// From any thread. Stays in force: every later wait returns at once.
  void wake();

 private:
  void attach_reader(dds_entity_t reader);

  Entity set_;
  Entity guard_;
  std::vector<Entity> conditions_;
};

}  // namespace adstar::dds
