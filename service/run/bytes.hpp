#pragma once
// Plain records to bytes and back, each block with its checksum (XXH3, 64 bits).

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace adstar::run {

using Bytes = std::vector<std::byte>;

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

template <class Record>
void append(Bytes& bytes, const Record& record) {
  static_assert(std::is_trivially_copyable_v<Record>);
  const std::size_t before = bytes.size();
  bytes.resize(before + sizeof record);
  std::memcpy(bytes.data() + before, &record, sizeof record);
}

/// Takes a record off the front; nothing, and nothing taken, when fewer bytes are left.
template <class Record>
std::optional<Record> take(std::span<const std::byte>& bytes) {
  static_assert(std::is_trivially_copyable_v<Record>);
  if (bytes.size() < sizeof(Record)) {
    return std::nullopt;
  }
  Record record;
  std::memcpy(static_cast<void*>(&record), bytes.data(), sizeof record);
  bytes = bytes.subspan(sizeof record);
  return record;
}

}  // namespace adstar::run
