#include "service/run/checkpoint.hpp"

#include <algorithm>
#include <array>

#include "service/run/files.hpp"

namespace adstar::run {
namespace {

constexpr std::array<char, 8> kMagic{'a', 'd', 's', 't', 'a', 'r', 'c', 'p'};
constexpr std::uint64_t kFormat = 1;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t format = kFormat;
  std::uint64_t run = 0;
  std::uint64_t fingerprint = 0;
  std::uint64_t step = 0;
  std::uint64_t next_number = 0;
  std::uint64_t first_journal = 0;
  std::uint64_t vehicles = 0;
  std::uint64_t gate_words = 0;
};

std::span<const std::byte> bytes_of(const std::vector<runtime::VehicleState>& vehicles) {
  return std::as_bytes(std::span(vehicles));
}

}  // namespace

Bytes to_bytes(const Checkpoint& c) {
  const Header header{kMagic,       kFormat,       c.run,           c.fingerprint,
                      c.step,       c.next_number, c.first_journal, c.vehicles.size(),
                      c.gate.size()};
  const std::span<const std::byte> parts[] = {
      std::as_bytes(std::span(&header, 1)), bytes_of(c.vehicles), std::as_bytes(std::span(c.gate))};
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
  constexpr std::uint64_t kVehicle = sizeof(runtime::VehicleState);
  // Division, not products: the counts may be anything.
  if (header->vehicles > bytes.size() / kVehicle || header->gate_words > bytes.size() / 8 ||
      header->vehicles * kVehicle + header->gate_words * 8 + 8 != bytes.size()) {
    throw RunError("is cut off or changed: its length is not what it says");
  }
  Checkpoint c{header->run,
               header->fingerprint,
               header->step,
               header->next_number,
               header->first_journal,
               {},
               {}};
  c.vehicles.resize(header->vehicles);
  c.gate.resize(header->gate_words);
  std::memcpy(static_cast<void*>(c.vehicles.data()), bytes.data(), header->vehicles * kVehicle);
  std::memcpy(c.gate.data(), bytes.data() + header->vehicles * kVehicle, header->gate_words * 8);
  bytes = bytes.subspan(bytes.size() - 8);
  if (take<std::uint64_t>(bytes) != checksum(whole.first(whole.size() - 8))) {
    throw RunError("was changed: its checksum does not match");
  }
  return c;
}

std::uint64_t state_hash(std::uint64_t step, const std::vector<runtime::VehicleState>& vehicles) {
  const std::array<std::uint64_t, 2> parts{step, checksum(bytes_of(vehicles))};
  return checksum(std::as_bytes(std::span(parts)));
}

}  // namespace adstar::run
