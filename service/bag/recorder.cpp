#include "service/bag/recorder.hpp"

#include <chrono>

namespace adstar::bag {

using namespace std::chrono_literals;

Recorder::Recorder(RollingWriter writer, std::size_t topics, std::size_t most_waiting_bytes)
    : intake_(topics, most_waiting_bytes),
      writer_(std::move(writer)),
      thread_([this] { work(); }) {}

Recorder::~Recorder() {
  intake_.close();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Recorder::work() {
  using Clock = std::chrono::steady_clock;
  constexpr auto kCommitEvery = 1s;
  try {
    Batch batch;
    auto committed = Clock::now();
    while (intake_.take(batch, 100ms)) {
      for (const Batch::Entry& entry : batch.entries) {
        writer_.add(entry.topic, entry.received_ns, batch.payload(entry));
      }
      if (Clock::now() - committed >= kCommitEvery) {
        writer_.commit();
        committed = Clock::now();
      }
    }
    writer_.commit();
  } catch (...) {
    failure_ = std::current_exception();
    intake_.close();
    failed_.store(true);
  }
}

const Metadata& Recorder::finish() {
  intake_.close();
  thread_.join();
  if (failure_) {
    std::rethrow_exception(failure_);
  }
  return writer_.finish();
}

}  // namespace adstar::bag
