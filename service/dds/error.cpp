#include "service/dds/error.hpp"

#include <exception>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace adstar::dds {
namespace {

std::string_view remedy(dds_return_t code) {
  switch (code) {
    case DDS_RETCODE_OUT_OF_RESOURCES:
      return "raise the limits on memory, file descriptors or threads (ulimit -a)";
    case DDS_RETCODE_PRECONDITION_NOT_MET:
      return "another part of this process already uses it otherwise; make it once";
    case DDS_RETCODE_BAD_PARAMETER:
    case DDS_RETCODE_INCONSISTENT_POLICY:
      return "check [dds] in the scene (or the options given): domain, partition, interface";
    case DDS_RETCODE_NOT_ALLOWED_BY_SECURITY:
      return "its certificate and signed permissions do not allow it here and now; see "
             "deploy/security/README.md";
    case DDS_RETCODE_TIMEOUT:
      return "the network or a reader is too slow; try again";
    default:
      return "the lines of 'dds' above in the log say more";
  }
}

}  // namespace

std::string describe(dds_return_t code, std::string_view call, std::string_view subject) {
  return fmt::format("{} on {} failed: {}; {}", call, subject, dds_strretcode(code), remedy(code));
}

dds_return_t check(dds_return_t code, std::string_view call, std::string_view subject) {
  if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY) {
    throw NotAllowed(describe(code, call, subject));
  }
  if (code < 0) {
    throw Error(describe(code, call, subject));
  }
  return code;
}

void check_quietly(dds_return_t code, std::string_view call, std::string_view subject) noexcept {
  if (code >= 0) {
    return;
  }
  try {
    spdlog::warn("{}", describe(code, call, subject));
  } catch (const std::exception&) {
    // Without memory for the message there is nobody left to tell.
  }
}

}  // namespace adstar::dds
