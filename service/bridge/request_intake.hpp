#pragma once
// StepRequest and RunControl samples become records in their rings. Only names are looked at here:
// adstard judges the rest.

#include <cstdint>
#include <string>

#include "service/bridge/directory.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/runtime/shared_segment.hpp"

namespace adstar::bridge {

/// Of one thread, the only producer of the two rings.
class RequestIntake {
 public:
  RequestIntake(const dds::Participant& participant, runtime::SharedSegment& segment,
                const Directory& directory, std::string service);

  void attach_to(dds::WaitSet& wait_set) const {
    wait_set.attach(steps_);
    wait_set.attach(controls_);
  }

  /// Hands over what has come, at most a batch of each; false when there was nothing.
  bool take_some();

 private:
  void take(const adstar_StepRequest& request);
  void take(const adstar_RunControl& request);

  runtime::SharedSegment& segment_;
  const Directory& directory_;
  std::string service_;
  dds::Reader<adstar_StepRequest> steps_;
  dds::Reader<adstar_RunControl> controls_;
};

}  // namespace adstar::bridge
