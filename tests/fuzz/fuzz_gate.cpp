// Any bytes as commands and beats through the command gate: every command must end in exactly one
// final verdict, every window must be in order.
//
// Bytes: size of the pool, then operations. 0: a beat. Anything else: a command; its bits say which
// of its fields are near what makes sense (short) and which are anything at all (long).

#include <limits>
#include <string>

#include "tests/fuzz/byte_stream.hpp"
#include "tests/support/gate_invariants.hpp"

namespace {

using namespace adstar;
using fuzz::ByteStream;
using test::kMs;

constexpr double kLimit_n_m = 1.0;

std::int64_t a_time(ByteStream& bytes, bool anything, std::int64_t now_ns) {
  return anything ? bytes.take<std::int64_t>() : now_ns + bytes.take<std::int16_t>() * (kMs / 8);
}

runtime::CommandRecord a_command(ByteStream& bytes, std::uint8_t kind, std::int64_t now_ns) {
  runtime::CommandRecord c;
  const auto who = bytes.take<std::uint8_t>();
  c.commander = {0, who & 7U};
  c.spacecraft = (who >> 3) & 3U;  // two of four exist
  c.actuator = who == 0xff ? 0xffff'ffffU : (who >> 5) & 3U;
  const bool anything = (kind & 1U) != 0;
  c.sequence = (kind & 2U) != 0 ? bytes.take<std::uint64_t>() : bytes.take<std::uint8_t>();
  c.priority = bytes.take<std::int8_t>();
  c.quantity = (kind & 64U) != 0 ? runtime::Quantity::wheel_speed : runtime::Quantity::torque;
  c.start_ns = (kind & 4U) != 0 ? runtime::kStartAtNextBeat : a_time(bytes, anything, now_ns);
  if ((kind & 8U) == 0) {
    c.duration_ns = anything ? bytes.take<std::int64_t>() : bytes.take<std::uint8_t>() * kMs / 4;
  }
  if ((kind & 24U) != 0) {
    c.end_ns = a_time(bytes, anything, now_ns);
  }
  for (double& x : c.value) {
    x = (kind & 32U) != 0 ? bytes.take<double>() : bytes.take<std::int8_t>() / 100.0;
  }
  return c;
}

class Flight {
 public:
  explicit Flight(std::size_t pool)
      : gate_({test::make_craft(2, Frame::body, {kLimit_n_m, kLimit_n_m, kLimit_n_m}),
               test::make_craft(2, Frame::inertial, {kLimit_n_m, kLimit_n_m, kLimit_n_m})},
              10 * kMs, pool) {}

  std::int64_t now_ns() const { return gate_.now_ns(); }

  void receive(const runtime::CommandRecord& command) {
    const bool exists = command.spacecraft < 2 && command.actuator < 2;
    const bool repeats = exists && !witness_.sent(command);
    gate_.receive(command);
    for (const runtime::VerdictRecord& verdict : gate_.take()) {
      if (!repeats) {
        witness_.heard(verdict);
      }
    }
    require(witness_.breach());
  }

  void beat() {
    const runtime::Beat now = gate_.now();
    for (const runtime::VerdictRecord& verdict : gate_.beat()) {
      witness_.heard(verdict);
    }
    require(witness_.breach());
    for (std::size_t spacecraft = 0; spacecraft < 2; ++spacecraft) {
      for (std::size_t torque = 0; torque < 2; ++torque) {
        require(test::window_breach(gate_.window(spacecraft, torque), now, kLimit_n_m));
      }
    }
  }

  /// The newest of the highest rank displaces whatever waits.
  void end() {
    for (std::uint32_t place = 0; place < 4; ++place) {
      runtime::CommandRecord last;
      last.commander = {1, place};
      last.sequence = 1;
      last.spacecraft = place / 2;
      last.actuator = place % 2;
      last.priority = std::numeric_limits<std::int32_t>::max();
      last.duration_ns = kMs;
      receive(last);
    }
    // A window holds few at a time; what it cannot hold begins at a later beat.
    for (int i = 0; i < 10; ++i) {
      beat();
    }
    witness_.all_told();
    require(witness_.breach());
  }

 private:
  static void require(const std::string& breach) {
    if (!breach.empty()) {
      fuzz::found(breach.c_str());
    }
  }

  test::GateHarness gate_;
  test::GateWitness witness_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteStream bytes(data, size);
  constexpr std::size_t kPools[] = {5, 64, 1024};
  Flight flight(kPools[bytes.take<std::uint8_t>() % 3]);
  while (!bytes.empty()) {
    const auto kind = bytes.take<std::uint8_t>();
    if (kind == 0) {
      flight.beat();
    } else {
      flight.receive(a_command(bytes, kind, flight.now_ns()));
    }
  }
  flight.end();
  return 0;
}
