#include "service/adstar/reflight_text.hpp"

#include <fmt/format.h>

#include "service/report/numbers.hpp"

namespace adstar::cli {
namespace {

std::string plural(std::uint64_t count, const char* one, const char* many) {
  return report::counted(count) + " " + (count == 1 ? one : many);
}

std::string text_of(const run::Instant& at) {
  return at.resets == 0 ? fmt::format("step {}", at.step)
                        : fmt::format("step {} after reset {}", at.step, at.resets);
}

}  // namespace

std::string reflight_text(const run::Reflight& flight) {
  std::string text = fmt::format("{} to {}, {}, compared at {} and {}\n", text_of(flight.from),
                                 text_of(flight.to), plural(flight.heard, "command", "commands"),
                                 plural(flight.hashes, "state hash", "state hashes"),
                                 plural(flight.checkpoints, "checkpoint", "checkpoints"));
  if (flight.differs_at) {
    text += fmt::format("differs: the same at {}, not at {}{}\n", text_of(flight.same_until),
                        text_of(*flight.differs_at),
                        flight.differs_in.empty() ? "" : ": " + flight.differs_in);
  } else if (flight.hashes + flight.checkpoints == 0) {
    text += "nothing to compare with: ";
    text += flight.from == run::Instant{}
                ? "the run ended before its first second\n"
                : fmt::format(
                      "what came before {}, its oldest checkpoint, is not kept; [run] history = "
                      "\"whole\" in the scene of the next run keeps all of it\n",
                      text_of(flight.from));
  } else {
    text += "same bits\n";
  }
  return text;
}

}  // namespace adstar::cli
