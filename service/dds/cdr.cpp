#include "service/dds/cdr.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

#include <dds/ddsi/ddsi_cdrstream.h>

namespace adstar::dds {
namespace {

// RTPS 2.5, table 10.3: encapsulation of final types, the low bit says little-endian.
constexpr unsigned kPlainCdr = 0x0000, kPlainCdr2 = 0x0006, kLittleEndian = 0x0001;
constexpr std::uint32_t kVersion1 = 1, kVersion2 = 2;
constexpr std::size_t kHeader = 4;

}  // namespace

bool read_sample(const dds_topic_descriptor_t& descriptor, std::span<const std::byte> payload,
                 void* sample) {
  if (payload.size() <= kHeader || payload.size() > UINT32_MAX) {
    return false;
  }
  const unsigned identifier =
      std::to_integer<unsigned>(payload[0]) << 8U | std::to_integer<unsigned>(payload[1]);
  const unsigned kind = identifier & ~kLittleEndian;
  if (kind != kPlainCdr && kind != kPlainCdr2) {
    return false;
  }
  const std::uint32_t version = kind == kPlainCdr ? kVersion1 : kVersion2;
  const bool swap =
      ((identifier & kLittleEndian) != 0) != (std::endian::native == std::endian::little);
  // Checked and swapped in place, and read from a block that is aligned as the wire is.
  const auto size = static_cast<std::uint32_t>(payload.size() - kHeader);
  std::vector<std::uint64_t> block((size + 7) / 8);
  std::memcpy(block.data(), payload.data() + kHeader, size);
  auto* const bytes = reinterpret_cast<char*>(block.data());
  std::uint32_t used = 0;
  if (dds_stream_normalize_data(bytes, &used, size, swap, version, descriptor.m_ops) == nullptr) {
    return false;
  }
  dds_istream_t stream;
  dds_istream_init(&stream, size, bytes, version);
  dds_stream_read(&stream, static_cast<char*>(sample), descriptor.m_ops);
  dds_istream_fini(&stream);
  return true;
}

void free_sample(const dds_topic_descriptor_t& descriptor, void* sample) noexcept {
  dds_stream_free_sample(sample, descriptor.m_ops);
}

}  // namespace adstar::dds
