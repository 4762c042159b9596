// adstar: the client. Each verb has a file of its own; this one puts them together.

#include <csignal>
#include <cstdio>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "service/adstar/failure.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/dds/error.hpp"
#include "service/propagation/plan.hpp"
#include "service/scene/scene.hpp"

namespace {

using namespace adstar;

int run(const cli::Verb& verb) {
  const auto complain = [&](const char* message) {
    fmt::print(stderr, "adstar {}: {}\n", verb.command->get_name(), message);
  };
  try {
    return verb.run();
  } catch (const cli::ReaderGone&) {
    return cli::kDone;
  } catch (const cli::Failure& failure) {
    complain(failure.what());
    return failure.code;
  } catch (const scene::SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return cli::kUsage;
  } catch (const propagation::Refused& error) {
    complain(error.what());
    return cli::kUsage;
  } catch (const dds::ConfigurationError& error) {
    complain(error.what());
    return cli::kUsage;
  } catch (const dds::NotAllowed& error) {
    complain(error.what());
    return cli::kRefused;
  } catch (const dds::Error& error) {
    complain(error.what());
    return cli::kFailed;
  } catch (const std::exception& error) {
    complain(error.what());
    return cli::kFailed;
  }
}

/// "-.5" is a number to people and an option to the parser.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::string& word : words) {
    if (word.size() > 2 && word.starts_with("-.") && word[2] >= '0' && word[2] <= '9') {
      word.insert(1, 1, '0');
    }
  }
  return {words.rbegin(), words.rend()};  // CLI11 takes them in reverse
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  CLI::App program("Satellite attitude propagation: scenes, torque commands, telemetry", "adstar");
  program.set_version_flag("--version", "adstar " ADSTAR_VERSION);
  program.require_subcommand(1);
  program.footer("Example:\n  adstar propagate configs/scenes/paper_free.toml --every 10s");

  const std::vector<cli::Verb> verbs{
      cli::add_propagate(program), cli::add_check(program),       cli::add_trade(program),
      cli::add_reproduce(program), cli::add_torque(program),      cli::add_wheel(program),
      cli::add_dipole(program),    cli::add_fire(program),        cli::add_joint(program),
      cli::add_monitor(program),   cli::add_list(program),        cli::add_timing(program),
      cli::add_dashboard(program), cli::add_replay(program),      cli::add_step(program),
      cli::add_pause(program),     cli::add_resume(program),      cli::add_reset(program),
      cli::add_set_state(program), cli::add_set_inertia(program), cli::add_set_target(program),
      cli::add_record(program),    cli::add_export(program),      cli::add_plot(program),
      cli::add_completion(program)};
  try {
    program.parse(arguments(argc, argv));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return program.exit(error);
    }
    fmt::print(stderr, "{}\n", cli::describe_usage_error(program, error));
    return cli::kUsage;
  }
  for (const cli::Verb& verb : verbs) {
    if (verb.command->parsed()) {
      return run(verb);
    }
  }
  return cli::kUsage;
}
