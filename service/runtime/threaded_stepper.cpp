#include "service/runtime/threaded_stepper.hpp"

#include <algorithm>
#include <barrier>
#include <thread>

namespace adstar::runtime {
namespace {

/// A part is worth a thread from here on, and a multiple of every register's width.
constexpr std::size_t kLeastPart = 64;

struct Part {
  std::size_t first = 0, count = 0;
  std::unique_ptr<Stepper> stepper;
  std::size_t unresolved = 0;
};

class ThreadedStepper final : public Stepper {
 public:
  explicit ThreadedStepper(std::vector<Part> parts)
      : parts_(std::move(parts)), gate_(static_cast<std::ptrdiff_t>(parts_.size())) {
    workers_.reserve(parts_.size() - 1);
    try {
      for (std::size_t i = 1; i < parts_.size(); ++i) {
        workers_.emplace_back([this, i] { work(parts_[i]); });
      }
    } catch (...) {
      // Those that did not start will not come to the gate.
      for (std::size_t i = workers_.size() + 1; i < parts_.size(); ++i) {
        gate_.arrive_and_drop();
      }
      stop();
      throw;
    }
  }
  ~ThreadedStepper() override { stop(); }

  std::size_t step(Vehicles vehicles, std::int64_t t_ns, std::int64_t h_ns) noexcept override {
    job_ = {vehicles, t_ns, h_ns};
    gate_.arrive_and_wait();  // off they go
    run(parts_[0]);
    gate_.arrive_and_wait();  // all are back
    std::size_t unresolved = 0;
    for (const Part& part : parts_) {
      unresolved += part.unresolved;
    }
    return unresolved;
  }

  // The workers wait at the gate between steps.
  void replace_body(std::size_t vehicle, const RigidBody<double>& body) noexcept override {
    const auto after =
        std::upper_bound(parts_.begin(), parts_.end(), vehicle,
                         [](std::size_t index, const Part& part) { return index < part.first; });
    const Part& part = *std::prev(after);
    part.stepper->replace_body(vehicle - part.first, body);
  }

 private:
  struct Job {
    Vehicles vehicles;
    std::int64_t t_ns = 0, h_ns = 0;
  };

  void run(Part& part) noexcept {
    Vehicle* const first = job_.vehicles.first + part.first;
    part.unresolved = part.stepper->step({first, first + part.count}, job_.t_ns, job_.h_ns);
  }

  void work(Part& part) noexcept {
    for (;;) {
      gate_.arrive_and_wait();
      if (stopping_) {
        return;
      }
      run(part);
      gate_.arrive_and_wait();
    }
  }

  void stop() noexcept {
    stopping_ = true;
    gate_.arrive_and_drop();
    for (std::thread& worker : workers_) {
      worker.join();
    }
  }

  std::vector<Part> parts_;
  std::barrier<> gate_;
  Job job_;
  bool stopping_ = false;  ///< written before the gate, read after it, as job_
  std::vector<std::thread> workers_;
};

}  // namespace

std::unique_ptr<Stepper> make_threaded_stepper(std::span<const Vehicle> vehicles,
                                               std::size_t threads, const StepperMaker& make) {
  const std::size_t worthwhile = std::max<std::size_t>(1, vehicles.size() / kLeastPart);
  const std::size_t count = std::clamp<std::size_t>(threads, 1, worthwhile);
  if (count == 1) {
    return make(vehicles);
  }
  std::vector<Part> parts(count);
  const std::size_t blocks = (vehicles.size() + kLeastPart - 1) / kLeastPart;
  for (std::size_t i = 0; i < count; ++i) {
    Part& part = parts[i];
    part.first = std::min(vehicles.size(), i * blocks / count * kLeastPart);
    part.count = std::min(vehicles.size(), (i + 1) * blocks / count * kLeastPart) - part.first;
    part.stepper = make(vehicles.subspan(part.first, part.count));
  }
  return std::make_unique<ThreadedStepper>(std::move(parts));
}

}  // namespace adstar::runtime
