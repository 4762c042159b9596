#pragma once
// What the verbs of run control have in common: ask, wait for the verdict, say it.

#include <run.h>

#include "service/adstar/request_options.hpp"

namespace adstar::cli {

/// Prints the verdict and returns the exit code. Throws Failure when none comes.
int control_run(const char* verb, const adstar_RunControl& request, const RequestOptions& options);

}  // namespace adstar::cli
