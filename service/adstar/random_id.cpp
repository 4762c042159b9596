#include "service/adstar/random_id.hpp"

#include <cerrno>
#include <cstring>
#include <sys/random.h>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"

namespace adstar::cli {

runtime::CommanderId random_id() {
  runtime::CommanderId id;
  if (getrandom(&id, sizeof id, 0) != static_cast<ssize_t>(sizeof id)) {
    throw Failure(kFailed, fmt::format("getrandom gave no commander id: {}", std::strerror(errno)));
  }
  return id;
}

}  // namespace adstar::cli
