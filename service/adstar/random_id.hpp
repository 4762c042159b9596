#pragma once
// Who this process is to a service.

#include "service/runtime/records.hpp"

namespace adstar::cli {

/// 128 random bits. Throws Failure.
runtime::CommanderId random_id();

}  // namespace adstar::cli
