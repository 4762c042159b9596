#include "service/dds/wait_set.hpp"

namespace adstar::dds {

WaitSet::WaitSet(const Participant& participant)
    : set_(dds_create_waitset(participant.handle()), "dds_create_waitset", "the wait set"),
      guard_(dds_create_guardcondition(participant.handle()), "dds_create_guardcondition",
             "the wait set's guard") {
  check(dds_waitset_attach(set_.handle(), guard_.handle(), 0), "dds_waitset_attach",
        "the wait set's guard");
}

void WaitSet::attach_reader(dds_entity_t reader) {
  conditions_.emplace_back(dds_create_readcondition(reader, DDS_ANY_STATE),
                           "dds_create_readcondition", "the wait set's reader");
  check(dds_waitset_attach(set_.handle(), conditions_.back().handle(), 0), "dds_waitset_attach",
        "the wait set's reader");
}

bool WaitSet::wait(std::chrono::nanoseconds timeout) {
  return check(dds_waitset_wait(set_.handle(), nullptr, 0, timeout.count()), "dds_waitset_wait",
               "the wait set") > 0;
}

void WaitSet::wake() {
  check(dds_set_guardcondition(guard_.handle(), true), "dds_set_guardcondition",
        "the wait set's guard");
}

}  // namespace adstar::dds
