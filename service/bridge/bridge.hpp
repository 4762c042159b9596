#pragma once
// The life of the bridge: attach, meet the other daemons, carry commands in and telemetry out, end.
//
// A segment that says `ready` at the start was left by a bridge that fell: this one takes over at
// once, and what goes wrong then is no reason to refuse a service that is running.

#include "service/bridge/options.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/scene/scene.hpp"

namespace adstar::bridge {

/// Exit codes, as all programs of the project use them.
enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kRefused = 3 };

/// Says in the segment why there will be no service, for adstard to repeat and act upon.
void refuse(runtime::SharedSegment& segment, const std::string& message);

/// Returns the exit code: kDone when asked to stop, kRefused when a rival was there first. Throws
/// dds::Error.
int run(const Options& options, const scene::Scene& scene, runtime::MappedSegment& segment);

}  // namespace adstar::bridge
