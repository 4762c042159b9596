#include "service/run/checkpoint.hpp"

#include <algorithm>
#include <array>

#include "service/run/files.hpp"

namespace adstar::run {
namespace {

constexpr std::array<char, 8> kMagic{'a', 'd', 's', 't', 'a', 'r', 'c', 'p'};
constexpr std::uint64_t kFormat = 4;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t format = kFormat;
  std::uint64_t run = 0;
  std::uint64_t fingerprint = 0;
  std::uint64_t resets = 0;
  std::uint64_t step = 0;
  std::uint64_t next_number = 0;
  std::uint64_t first_journal = 0;
  std::uint64_t vehicles = 0;
  std::uint64_t wheels = 0;
  std::uint64_t memory_words = 0;
  std::uint64_t gate_words = 0;
  std::uint64_t control_words = 0;
};

}  // namespace

Bytes to_bytes(const Checkpoint& c) {
  const Header header{kMagic,
                      kFormat,
                      c.run,
                      c.fingerprint,
                      c.at.resets,
                      c.at.step,
                      c.next_number,
                      c.first_journal,
                      c.fleet.vehicles.size(),
                      c.fleet.wheel_momenta.size(),
                      c.fleet.memory.size(),
                      c.gate.size(),
                      c.controls.size()};
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(&header, 1)),
                                              std::as_bytes(std::span(c.fleet.vehicles)),
                                              std::as_bytes(std::span(c.fleet.wheel_momenta)),
                                              std::as_bytes(std::span(c.fleet.memory)),
                                              std::as_bytes(std::span(c.gate)),
                                              std::as_bytes(std::span(c.controls))};
  std::size_t length = 0;
  for (const auto& part : parts) {
    length += part.size();
  }
  Bytes bytes(length + sizeof(std::uint64_t));
  std::byte* end = bytes.data();
  for (const auto& part : parts) {
    end = std::copy(part.begin(), part.end(), end);
  }
  const std::uint64_t sum = checksum(std::span(bytes).first(length));
  std::memcpy(end, &sum, sizeof sum);
  return bytes;
}

Checkpoint checkpoint_from(std::span<const std::byte> bytes) {
  const std::span<const std::byte> whole = bytes;
  const auto header = take<Header>(bytes);
  if (!header || header->magic != kMagic) {
    throw RunError("is no checkpoint, or was cut off at its beginning");
  }
  if (header->format != kFormat) {
    throw RunError("is a checkpoint of another format: made by another version of adstar");
  }
  // Each count against what is there before it is multiplied: they may be anything.
  constexpr std::uint64_t kVehicle = sizeof(runtime::VehicleState);
  constexpr std::uint64_t kWheel = sizeof(Sum<double>);
  const std::uint64_t most_words = bytes.size() / 8;
  if (header->vehicles > bytes.size() / kVehicle || header->wheels > bytes.size() / kWheel ||
      header->memory_words > most_words || header->gate_words > most_words ||
      header->control_words > most_words ||
      header->vehicles * kVehicle + header->wheels * kWheel +
              (header->memory_words + header->gate_words + header->control_words + 1) * 8 !=
          bytes.size()) {
    throw RunError("is cut off or changed: its length is not what it says");
  }
  Checkpoint c{header->run,
               header->fingerprint,
               {header->resets, header->step},
               header->next_number,
               header->first_journal,
               {},
               {},
               {}};
  c.fleet.vehicles.resize(header->vehicles);
  c.fleet.wheel_momenta.resize(header->wheels);
  c.fleet.memory.resize(header->memory_words);
  c.gate.resize(header->gate_words);
  c.controls.resize(header->control_words);
  const auto fill = [&bytes](auto& records) {
    const auto room = std::as_writable_bytes(std::span(records));
    std::copy_n(bytes.begin(), room.size(), room.begin());
    bytes = bytes.subspan(room.size());
  };
  fill(c.fleet.vehicles);
  fill(c.fleet.wheel_momenta);
  fill(c.fleet.memory);
  fill(c.gate);
  fill(c.controls);
  if (take<std::uint64_t>(bytes) != checksum(whole.first(whole.size() - 8))) {
    throw RunError("was changed: its checksum does not match");
  }
  return c;
}

std::uint64_t state_hash(std::uint64_t step, const runtime::FleetState& fleet) {
  const std::array<std::uint64_t, 4> parts{step, checksum(std::as_bytes(std::span(fleet.vehicles))),
                                           checksum(std::as_bytes(std::span(fleet.wheel_momenta))),
                                           checksum(std::as_bytes(std::span(fleet.memory)))};
  return checksum(std::as_bytes(std::span(parts)));
}

}  // namespace adstar::run
