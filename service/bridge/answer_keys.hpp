#pragma once
// What tells one instance of an answer's topic from another.

#include <string>

#include "service/dds/convert.hpp"

namespace adstar::bridge {

inline std::string key_text(const adstar_CommanderId& id) {
  return {reinterpret_cast<const char*>(&id), sizeof id};
}

/// One instance per spacecraft, actuator and commander.
inline std::string key_text(const adstar_CommandStatus& status) {
  std::string text(dds::text_of(status.spacecraft));
  text += '\0';
  text += dds::text_of(status.actuator);
  text += '\0';
  return text + key_text(status.commander);
}

// One instance per asker: the service is always this one.
inline std::string key_text(const adstar_StepReply& reply) { return key_text(reply.requester); }
inline std::string key_text(const adstar_RunControlStatus& status) {
  return key_text(status.commander);
}

}  // namespace adstar::bridge
