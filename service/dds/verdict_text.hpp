#pragma once
// Verdicts and refusals in words, for logs and for the client.

#include "service/runtime/records.hpp"

namespace adstar::dds {

/// "accepted", "applied_late", ...: as service/pages/commands.md spells them.
const char* verdict_text(runtime::Verdict verdict) noexcept;

/// "unknown_actuator", ...
const char* reason_name(runtime::Reason reason) noexcept;

/// What is wrong and what to do about it, in a sentence.
const char* reason_text(runtime::Reason reason) noexcept;

/// Every verdict but `accepted` ends a command.
constexpr bool is_final(runtime::Verdict verdict) noexcept {
  return verdict != runtime::Verdict::accepted;
}

}  // namespace adstar::dds
