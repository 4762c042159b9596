// adstard: lock memory, start the bridge, run the tick, look after both, end cleanly.

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <sys/random.h>
#include <thread>
#include <time.h>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "service/adstard/bridge_care.hpp"
#include "service/adstard/bridge_process.hpp"
#include "service/adstard/housekeeping.hpp"
#include "service/adstard/keeping.hpp"
#include "service/adstard/options.hpp"
#include "service/adstard/scene_text.hpp"
#include "service/adstard/standby_watch.hpp"
#include "service/adstard/supervisor.hpp"
#include "service/log.hpp"
#include "service/report/scene_report.hpp"
#include "service/run/checkpoint.hpp"
#include "service/run/files.hpp"
#include "service/runtime/admission.hpp"
#include "service/runtime/real_time.hpp"
#include "service/runtime/shared_segment.hpp"
#include "service/runtime/tick.hpp"
#include "service/scene/scene.hpp"

namespace {

using namespace adstar;
using namespace adstar::adstard;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kLookPeriod = kSecond;
constexpr int kBridgePatienceMs = 3000;
constexpr std::int64_t kBridgeStart = 10 * kSecond;

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

/// SIGINT and SIGTERM, blocked in every thread and taken here; 0 when none came within 20 ms.
int take_signal(const sigset_t& signals) {
  const timespec patience{0, 20'000'000};
  const int signal = sigtimedwait(&signals, nullptr, &patience);
  return signal > 0 ? signal : 0;
}

std::string bridge_message(const runtime::SharedSegment& segment) {
  // The bridge may write while this reads: copy what is there, printable characters only.
  std::string message;
  for (std::size_t i = 0; i + 1 < sizeof segment.bridge_message; ++i) {
    const char c = segment.bridge_message[i];
    if (c == '\0') {
      break;
    }
    message += c >= ' ' && c <= '~' ? c : ' ';
  }
  return message;
}

void require_security_files(const scene::Scene& scene, const std::string& file) {
  if (!scene.dds.security) {
    return;
  }
  std::vector<std::string> complaints = scene::complaints_about(*scene.dds.security);
  for (std::string& complaint : complaints) {
    complaint = fmt::format("{}: dds.security.{}", file, complaint);
  }
  if (!complaints.empty()) {
    throw scene::SceneError(complaints);
  }
}

/// Whether the scene fits this machine, by its own measure; says what it found.
bool admitted(const scene::Scene& scene) {
  if (scene.simulation.pace != scene::Pace::clock) {
    return true;
  }
  const runtime::StepCost cost = runtime::measure_step(scene);
  const std::string misfit = runtime::why_it_does_not_fit(scene, cost);
  if (misfit.empty()) {
    spdlog::info("a step costs at most {:.1f} us here (p99 of {} at the sub-step limit)",
                 static_cast<double>(cost.p99_ns) * 1e-3, cost.steps);
    return true;
  }
  spdlog::log(scene.budget.refuse_at_start ? spdlog::level::err : spdlog::level::warn, "{}",
              misfit);
  return !scene.budget.refuse_at_start;
}

/// Waits until the bridge has found its place on the bus. kDone when it has.
int await_bridge(BridgeProcess& bridge, const runtime::SharedSegment& segment,
                 const sigset_t& signals) {
  const std::int64_t patience_ends = clock_ns(CLOCK_MONOTONIC) + kBridgeStart;
  while (true) {
    const auto state = static_cast<runtime::BridgeState>(segment.bridge_state.load());
    if (state == runtime::BridgeState::ready) {
      return kDone;
    }
    if (!bridge.alive()) {
      const std::string message = bridge_message(segment);
      spdlog::error("{}", message.empty() ? "the bridge " + bridge.how() : message);
      return bridge.exit_code() > 0 ? bridge.exit_code() : static_cast<int>(kFailed);
    }
    if (const int signal = take_signal(signals); signal != 0) {
      spdlog::info("stopped by signal {} before the first step", signal);
      return kFailed;
    }
    if (clock_ns(CLOCK_MONOTONIC) > patience_ends) {
      spdlog::error("the bridge is not ready after {} s; is DDS usable on this machine?",
                    kBridgeStart / kSecond);
      return kFailed;
    }
  }
}

/// A standby's: waits for the state of its primary, which may not be there yet. Nothing when a signal came
/// first.
std::optional<run::Checkpoint> await_state(BridgeCare& care, const BridgeProcess& bridge,
                                           const runtime::MappedSegment& segment,
                                           Housekeeping& housekeeping, Supervisor& supervisor,
                                           const Plan& plan, const sigset_t& signals) {
  spdlog::info("a standby of '{}': waits for its primary", plan.scene.service.name);
  std::int64_t next_look = 0;
  while (segment->standby.state_received.load() == 0) {
    if (take_signal(signals) != 0) {
      return std::nullopt;
    }
    const std::int64_t now = clock_ns(CLOCK_MONOTONIC);
    supervisor.look(now);
    care.look(now);
    if (now >= next_look) {
      housekeeping.look(bridge.restarts(), {}, false);
      next_look = now + kLookPeriod;
    }
  }
  return run::checkpoint_from(run::read_bytes(run::RunDirectory::received_path(plan.run->path())));
}

void log_start(const scene::Scene& scene) {
  const scene::Simulation& s = scene.simulation;
  spdlog::info("'{}' propagates {} spacecraft with {}, step {}, pace {}{}{}", scene.service.name,
               scene.spacecraft.size(), s.scheme, scene::format_duration(s.step_ns),
               scene::name_of(s.pace),
               s.pace == scene::Pace::clock && s.rate != 1.0 ? fmt::format(" x {}", s.rate) : "",
               s.duration_ns ? ", for " + scene::format_duration(*s.duration_ns) : ", endless");
  const std::string models = report::scene_report(scene);
  spdlog::info("models and leaves out:\n{}", models.substr(0, models.find_last_not_of('\n') + 1));
}

int fly(Plan& plan, const Options& options, const sigset_t& signals) {
  const scene::Scene& scene = plan.scene;
  runtime::MappedSegment segment = runtime::MappedSegment::create(
      scene.telemetry.fleet_every != 0 ? scene.spacecraft.size() : 0);
  runtime::Tick tick(scene, segment);
  Housekeeping housekeeping(scene, tick, segment);
  begin_run(plan, options);
  std::optional<Keeping> keeping;
  if (options.standby) {
    tick.stand_by();
  } else {
    keeping.emplace(plan, options, tick, segment);
  }

  BridgeCommand command{bridge_beside_this_program(),
                        segment.fd(),
                        make_sealed_memfd(plan.text),
                        plan.file,
                        scene.service.name,
                        {},
                        clock_ns(CLOCK_REALTIME),
                        options.standby,
                        plan.run ? plan.run->path().string() : ""};
  if (getrandom(&command.instance, sizeof command.instance, 0) != sizeof command.instance) {
    throw std::system_error(errno, std::generic_category(), "getrandom");
  }
  BridgeProcess bridge(command);
  bridge.start();
  if (const int code = await_bridge(bridge, *segment, signals); code != kDone) {
    segment->stop_requested.store(1);
    bridge.finish(kBridgePatienceMs);
    if (keeping) {
      keeping->finish(tick);  // it can be gone on with from here
    }
    return code;
  }
  log_start(scene);
  Supervisor supervisor(scene.simulation.pace == scene::Pace::clock
                            ? scene::beat_ns(scene.simulation)
                            : std::int64_t{0});
  supervisor.ready(fmt::format("'{}' {} {} spacecraft", scene.service.name,
                               options.standby ? "stands by for" : "flies",
                               scene.spacecraft.size()));
  BridgeCare care(bridge, segment, clock_ns(CLOCK_MONOTONIC));
  if (options.standby) {
    const auto state = await_state(care, bridge, segment, housekeeping, supervisor, plan, signals);
    if (!state) {
      segment->stop_requested.store(1);
      bridge.finish(kBridgePatienceMs);
      return kDone;
    }
    keeping.emplace(plan, options, tick, segment, &*state);
    segment->standby.following.store(1);
  }

  runtime::RealTime real_time;
  runtime::lock_memory(real_time);
  const bool by_clock = scene.simulation.pace == scene::Pace::clock;
  std::optional<runtime::ShallowIdle> idle;
  if (by_clock && scene.service.priority > 0 && scene.service.cpu) {
    idle.emplace(real_time);
  }
  std::atomic<bool> stop{false};
  std::atomic<bool> prepared{false};
  std::atomic<bool> ended{false};
  std::atomic<bool> dismissed{false};
  std::thread tick_thread([&] {
    runtime::make_thread_real_time(by_clock ? scene.service.priority : 0, scene.service.cpu,
                                   real_time);
    prepared.store(true);
    prepared.notify_one();
    tick.run(stop);
    ended.store(true);
    dismissed.wait(false);  // the system's account of a thread ends with it
  });
  prepared.wait(false);
  for (const std::string& warning : real_time.warnings) {
    spdlog::warn("{}", warning);
  }
  if (real_time.idle_is_shallow) {
    spdlog::info("no processor sleeps deeply while this flies (/dev/cpu_dma_latency)");
  }
  housekeeping.watch_thread(real_time.thread);

  std::int64_t next_look = 0;
  int exit_code = kDone;
  StandbyWatch standby_watch(*segment);
  bool follows = options.standby;
  while (!ended.load()) {
    if (follows && tick.report().following.load(std::memory_order_relaxed) == 0) {
      follows = false;
      supervisor.tell(fmt::format("'{}' has taken over, and flies {} spacecraft",
                                  scene.service.name, scene.spacecraft.size()));
    }
    if (const auto why = standby_watch.why_to_end(); why && !stop.load()) {
      spdlog::error("stopping: {}", *why);
      exit_code = kRefused;
      stop.store(true);
    }
    if (const int signal = take_signal(signals); signal != 0) {
      spdlog::info("stopping: {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
      stop.store(true);
    }
    const std::int64_t now = clock_ns(CLOCK_MONOTONIC);
    supervisor.look(tick.report().turns.load(std::memory_order_relaxed), now);
    care.look(now);
    if (now >= next_look) {
      housekeeping.look(bridge.restarts(), keeping->newest_hash(), false);
      next_look = now + kLookPeriod;
    }
  }
  supervisor.stopping();
  housekeeping.thread_is_done();
  dismissed.store(true);
  dismissed.notify_one();
  tick_thread.join();

  tick.publish_final(kBridgePatienceMs / 3);
  keeping->finish(tick);
  housekeeping.look(bridge.restarts(), keeping->newest_hash(), true);
  segment->stop_requested.store(1);
  runtime::wake_bridge(*segment);
  bridge.finish(kBridgePatienceMs);
  housekeeping.summarise();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = kDone;
  const std::optional<Options> options = parse_options(argc, argv, exit_code);
  if (!options) {
    return exit_code;
  }
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a log reader that goes away must not end the run
  try {
    Plan plan = make_plan(*options);
    require_security_files(plan.scene, plan.file);
    set_up_log(plan.scene.log, "adstard");
    if (!admitted(plan.scene)) {
      return kRefused;
    }
    return fly(plan, *options, signals);
  } catch (const run::RunError& error) {
    fmt::print(stderr, "adstard: {}\n", error.what());
    return kRefused;
  } catch (const scene::SceneError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "adstard: {}\n", error.what());
    return kFailed;
  }
}
