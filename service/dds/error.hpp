#pragma once
// One way to report a failed DDS call: which call, on what, Cyclone's word for it, and what to do.

#include <stdexcept>
#include <string>
#include <string_view>

#include <dds/dds.h>

namespace adstar::dds {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What was asked for cannot be had as it is configured: the caller's files or options are wrong.
struct ConfigurationError : Error {
  using Error::Error;
};

/// The permissions of this participant do not allow it.
struct NotAllowed : Error {
  using Error::Error;
};

/// "dds_write on 'adstar/attitude_state' failed: Out of Resources; ..."
std::string describe(dds_return_t code, std::string_view call, std::string_view subject);

/// Returns `code` when it is not an error; throws Error when it is.
dds_return_t check(dds_return_t code, std::string_view call, std::string_view subject);

/// For destructors: logs instead of throwing.
void check_quietly(dds_return_t code, std::string_view call, std::string_view subject) noexcept;

}  // namespace adstar::dds
