// Any bytes as a journal and as a checkpoint. Whole ones are rare among random bytes, so the sums are put
// right first: what is left is what somebody could write on purpose.

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "service/run/checkpoint.hpp"
#include "service/run/files.hpp"
#include "service/run/journal_file.hpp"
#include "service/runtime/gate.hpp"
#include "tests/fuzz/byte_stream.hpp"
#include "tests/support/gate_harness.hpp"

namespace {

using namespace adstar;

void require(bool holds, const char* what) {
  if (!holds) {
    fuzz::found(what);
  }
}

constexpr std::size_t kHeader = 32;
constexpr std::size_t kRecord = sizeof(runtime::JournalRecord);

void put_sum(run::Bytes& bytes, std::size_t begin, std::size_t length) {
  if (begin + length + 8 <= bytes.size()) {
    const std::uint64_t sum = run::checksum(std::span(bytes).subspan(begin, length));
    std::memcpy(bytes.data() + begin + length, &sum, 8);
  }
}

void read_journal(run::Bytes bytes) {
  const run::JournalText as_it_is = run::journal_from(bytes);
  require(as_it_is.records.size() * kRecord <= bytes.size(), "records out of nothing");
  for (std::size_t at = kHeader; at < bytes.size(); at += kRecord + 8) {
    put_sum(bytes, at, kRecord);
  }
  const run::JournalText text = run::journal_from(bytes);
  const bool headed = text.run != 0 || !text.records.empty();
  require(!headed || text.records.size() == (bytes.size() - kHeader) / (kRecord + 8),
          "a record with the right sum was refused");
}

void read_checkpoint(run::Bytes bytes, const std::vector<scene::Spacecraft>& spacecraft) {
  if (bytes.size() > 8) {
    put_sum(bytes, 0, bytes.size() - 8);
  }
  try {
    const run::Checkpoint checkpoint = run::checkpoint_from(bytes);
    require(run::to_bytes(checkpoint) == bytes, "another checkpoint than that of the bytes");
    static const auto ring = std::make_unique<runtime::VerdictRing>();
    runtime::CommandGate gate(spacecraft, *ring, 64);
    if (gate.load(checkpoint.gate)) {
      for (std::uint64_t step = 0; step < 20; ++step) {
        gate.begin_step({step, static_cast<std::int64_t>(step) * 10'000'000, 10'000'000});
      }
      (void)gate.save();
    }
    ring->skip_all();
  } catch (const run::RunError& error) {
    require(*error.what() != '\0', "a refusal says nothing");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<scene::Spacecraft> kSpacecraft{test::make_craft(2), test::make_craft(1)};
  const auto* const begin = reinterpret_cast<const std::byte*>(data);
  read_journal({begin, begin + size});
  read_checkpoint({begin, begin + size}, kSpacecraft);
  return 0;
}
