#pragma once
// What became of step requests and run control, in words, for logs and for the client.

#include "service/runtime/records.hpp"

namespace adstar::dds {

/// "busy", "not_standing", ...
const char* refusal_name(runtime::StepRefusal refusal) noexcept;
/// "not_allowed", "bad_inertia", ...
const char* refusal_name(runtime::ControlRefusal refusal) noexcept;

/// What is wrong and what to do about it, in a sentence.
const char* refusal_text(runtime::StepRefusal refusal) noexcept;
const char* refusal_text(runtime::ControlRefusal refusal) noexcept;

/// "pause", "set_state", ...
const char* action_name(runtime::ControlAction action) noexcept;

}  // namespace adstar::dds
