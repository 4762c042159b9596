#pragma once

#include <ctime>

#include <gtest/gtest.h>

#include "service/runtime/admission.hpp"

namespace adstar::test {

/// A step at its dearest (admission.hpp), of the processor's time: what another process takes in between does not count.
inline double ns_of_the_processor(const scene::Scene& scene) {
  const auto now_ns = [] {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
  };
  const double begun = now_ns();
  const runtime::StepCost cost = runtime::measure_step(scene);
  EXPECT_GT(cost.p99_ns, 0);
  return (now_ns() - begun) / static_cast<double>(cost.steps);
}

}  // namespace adstar::test
