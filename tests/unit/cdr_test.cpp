// Samples out of recorded bytes: the right ones to the bit, the wrong ones not at all.

#include "service/dds/cdr.hpp"

#include <cstring>

#include <dds/ddsi/ddsi_cdrstream.h>
#include <gtest/gtest.h>

#include "service/dds/convert.hpp"

namespace adstar::dds {
namespace {

/// As Cyclone puts it on the wire on this machine.
template <class T>
std::vector<std::byte> payload_of(const T& sample) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, 1);
  dds_stream_writeLE(&stream, reinterpret_cast<const char*>(&sample),
                     topic_of<T>().descriptor->m_ops);
  std::vector<std::byte> payload(4 + stream.x.m_index);
  payload[1] = std::byte{1};
  std::memcpy(payload.data() + 4, stream.x.m_buffer, stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return payload;
}

adstar_MomentumState some_momentum() {
  adstar_MomentumState s{};
  set_text(s.spacecraft, "sat1");
  set_text(s.service, "fly");
  s.step = 77;
  s.momentum_inertial_n_m_s = {0.1, -0.2, 0.3};
  s.energy_residual_j = -1e-17;
  s.flags = 4;
  return s;
}

TEST(Cdr, gives_the_sample_back) {
  const auto payload = payload_of(some_momentum());
  bool used = false;
  EXPECT_TRUE(with_sample<adstar_MomentumState>(payload, [&](const adstar_MomentumState& s) {
    used = true;
    EXPECT_EQ(text_of(s.spacecraft), "sat1");
    EXPECT_EQ(s.step, 77U);
    EXPECT_EQ(s.momentum_inertial_n_m_s.y, -0.2);
    EXPECT_EQ(s.energy_residual_j, -1e-17);
    EXPECT_EQ(s.flags, 4U);
  }));
  EXPECT_TRUE(used);
}

TEST(Cdr, gives_sequences_and_frees_them) {
  std::vector<adstar_FleetMember> members(3);
  members[2].rotational_energy_j = 5;
  adstar_FleetState fleet{};
  set_text(fleet.service, "fly");
  fleet.members._length = fleet.members._maximum = 3;
  fleet.members._buffer = members.data();
  EXPECT_TRUE(with_sample<adstar_FleetState>(payload_of(fleet), [](const adstar_FleetState& s) {
    ASSERT_EQ(s.members._length, 3U);
    EXPECT_EQ(s.members._buffer[2].rotational_energy_j, 5);
  }));
}

TEST(Cdr, refuses_bytes_that_end_too_soon) {
  const auto payload = payload_of(some_momentum());
  for (std::size_t size = 0; size < payload.size(); ++size) {
    EXPECT_FALSE(with_sample<adstar_MomentumState>(
        std::span(payload).first(size), [](const adstar_MomentumState&) { ADD_FAILURE(); }))
        << size;
  }
}

TEST(Cdr, refuses_lengths_that_lie_and_encodings_that_it_does_not_know) {
  auto payload = payload_of(some_momentum());
  payload[6] = std::byte{0xff};  // of the first string
  EXPECT_FALSE(with_sample<adstar_MomentumState>(payload, [](const adstar_MomentumState&) {}));
  payload = payload_of(some_momentum());
  payload[1] = std::byte{3};  // a parameter list
  EXPECT_FALSE(with_sample<adstar_MomentumState>(payload, [](const adstar_MomentumState&) {}));
}

}  // namespace
}  // namespace adstar::dds
