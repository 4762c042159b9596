// [run]: what a run leaves on disk.

#include <array>

#include "service/scene/duration_key.hpp"
#include "service/scene/sections.hpp"

namespace adstar::scene {

Run read_run(Keys& root) {
  Keys keys = root.section("run", "[run] on a line of its own");
  Run run;
  run.directory =
      read_text(keys.optional("directory"), {"the path of a directory", "\"runs/monday\""})
          .value_or("");
  run.checkpoint_every_ns =
      read_duration(keys.optional("checkpoint_every"), "10s").value_or(run.checkpoint_every_ns);
  constexpr std::array<std::string_view, 2> kHistories{"recent", "whole"};
  run.whole_history = read_choice(keys.optional("history"), kHistories).value_or(0) == 1;
  constexpr std::array<std::string_view, 2> kHashes{"second", "step"};
  run.hashes_every_step = read_choice(keys.optional("hashes"), kHashes).value_or(0) == 1;
  keys.refuse_unknown();
  return run;
}

}  // namespace adstar::scene
