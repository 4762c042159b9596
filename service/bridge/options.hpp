#pragma once
// What adstard tells its bridge on the command line.

#include <cstdint>
#include <optional>
#include <string>
#include <sys/types.h>

#include "service/runtime/records.hpp"

namespace adstar::bridge {

struct Options {
  int segment_fd = -1;            ///< the shared segment
  int scene_fd = -1;              ///< a memfd with the text of the scene
  std::string scene_file;         ///< its name, for messages
  std::string service;            ///< what the daemon calls itself
  runtime::CommanderId instance;  ///< 128 random bits of the daemon process
  std::int64_t started_utc_ns = 0;
  bool standby = false;  ///< begins as one
  std::string run;       ///< directory of the run; empty: none
  pid_t parent = 0;
};

/// Nothing when the arguments are not what adstard passes.
std::optional<Options> parse_options(int argc, char** argv);

}  // namespace adstar::bridge
