#pragma once
// What the verbs that command something have in common: their options, and one order until its verdict.

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "service/adstar/commander.hpp"
#include "service/adstar/failure.hpp"

namespace adstar::cli {

struct OrderOptions {
  Commander::Target target;
  std::optional<std::int64_t> for_ns, until_ns, at_ns, timeout_ns;
  std::int32_t priority = 0;
  bool wait = false;
  dds::ParticipantOptions place;

  std::int64_t timeout() const { return timeout_ns.value_or(5'000'000'000); }
  /// When and how long; what is for the verb to say.
  Order order() const;
};

void add_order_options(CLI::App& verb, OrderOptions& options);

/// Throws Failure unless exactly one of --for and --until is given.
void require_an_end(const OrderOptions& options);

/// One order until its verdict, which it prints. An immediate one is final within a beat, so that is waited for;
/// where none comes the clock stands, and it begins with the next step.
ExitCode run_order(Commander& commander, const Order& order, const OrderOptions& options);

/// The whole of a verb that gives one order: joins the bus under that name, gives it, prints its verdict.
ExitCode send_order(const char* verb, const Order& order, const OrderOptions& options);

/// What such a verb's help ends with.
std::string order_footer(const char* example);

/// Throws Failure that says where nobody answered, for kNoAnswer; else gives the code back.
ExitCode answered(ExitCode code, const Commander& commander, const OrderOptions& options);

}  // namespace adstar::cli
