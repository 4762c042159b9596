// service/dds against the real library: participants, their errors, what peers are told.

#include <arpa/inet.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include "service/bridge/status_writer.hpp"
#include "service/dds/convert.hpp"
#include "service/dds/incompatible_qos.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/wait_set.hpp"
#include "service/dds/writer.hpp"
#include "tests/integration/bridge_harness.hpp"

namespace adstar {
namespace {

using namespace std::chrono_literals;
using testing::eventually;

template <class Work>
std::string error_of(Work&& work) {
  try {
    work();
  } catch (const dds::Error& error) {
    return error.what();
  }
  return "";
}

TEST(DdsParticipant, ignores_a_broken_CYCLONEDDS_URI) {
  setenv("CYCLONEDDS_URI", "<Nonsense", 1);
  const dds::Participant participant(testing::private_corner());
  EXPECT_GT(participant.handle(), 0);
  unsetenv("CYCLONEDDS_URI");
}

TEST(DdsParticipant, can_be_made_again_after_it_has_gone) {
  for (int i = 0; i < 3; ++i) {
    dds::Participant participant(testing::private_corner());
    EXPECT_GE(participant.bind_sockets_to_interface(), 2U);
  }
}

TEST(DdsParticipant, leaves_the_sockets_of_others_alone) {
  const int mine = socket(AF_INET, SOCK_DGRAM, 0);
  const dds::Participant participant(testing::private_corner());
  char device[16] = {};
  socklen_t size = sizeof device;
  EXPECT_EQ(getsockopt(mine, SOL_SOCKET, SO_BINDTODEVICE, device, &size), 0);
  EXPECT_EQ(size, 0U);
  close(mine);
}

TEST(DdsParticipant, says_that_a_high_domain_shares_its_ports_when_they_are_taken) {
  const int other = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  std::uint32_t domain = scene::kMostSafeDomain;
  do {
    ASSERT_LT(++domain, 200U) << "not one port to be had: " << strerror(errno);
    any.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
  } while (bind(other, reinterpret_cast<const sockaddr*>(&any), sizeof any) != 0);
  const std::string error = error_of([&] { dds::Participant({domain}); });
  const std::string expected = fmt::format(
      "dds_create_domain on domain {} on interface 'lo' (above 101 Linux hands", domain);
  EXPECT_EQ(error.find(expected), 0U) << error;
  close(other);
}

TEST(DdsParticipant, names_the_interfaces_there_are_when_it_is_given_another) {
  const std::string error = error_of([] { dds::Participant({0, "nosuch0", ""}); });
  EXPECT_EQ(error.find("no network interface 'nosuch0'; try one of: lo"), 0U) << error;
}

TEST(DdsParticipant, reports_call_domain_and_remedy_when_the_domain_is_taken) {
  const dds::ParticipantOptions where = testing::private_corner();
  const dds::Participant first(where);
  EXPECT_EQ(
      error_of([&] { const dds::Participant second(where); }),
      fmt::format(
          "dds_create_domain on domain {} on interface 'lo' failed: Precondition Not Met; another "
          "part of this process already uses it otherwise; make it once",
          where.domain));
}

TEST(DdsReader, tells_samples_from_the_end_of_their_writer) {
  const dds::Participant participant(testing::private_corner());
  dds::Reader<adstar_AttitudeState> reader(participant);
  dds::WaitSet wait_set(participant);
  wait_set.attach(reader);
  EXPECT_FALSE(wait_set.wait(1ms));
  EXPECT_EQ(reader.take([](const auto&, const auto&) {}), 0U);
  adstar_AttitudeState sample{};
  dds::set_text(sample.spacecraft, "sat1");
  sample.step = 4;
  std::uint64_t step = 0;
  std::string gone;
  {
    dds::Writer<adstar_AttitudeState> writer(participant);
    ASSERT_TRUE(writer.write(sample));
    EXPECT_TRUE(wait_set.wait(20s));
    reader.take([&](const auto& state, const auto&) { step = state.step; });
    EXPECT_EQ(step, 4U);
  }
  EXPECT_TRUE(wait_set.wait(20s));
  EXPECT_TRUE(eventually([&] {
    reader.take([](const auto&, const auto&) {},
                [&](const auto& key, const auto&) { gone = dds::text_of(key.spacecraft); });
    return gone == "sat1";
  }));
  wait_set.wake();
  EXPECT_TRUE(wait_set.wait(20s));
}

TEST(DdsReader, returns_its_loan_when_the_callback_throws) {
  const dds::Participant participant(testing::private_corner());
  dds::Reader<adstar_AttitudeState> reader(participant);
  dds::Writer<adstar_AttitudeState> writer(participant);
  adstar_AttitudeState sample{};
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(writer.write(sample));
    EXPECT_THROW(reader.take([](const auto&, const auto&) { throw std::runtime_error("no"); }),
                 std::runtime_error);
  }
  ASSERT_TRUE(writer.write(sample));
  EXPECT_EQ(reader.take([](const auto&, const auto&) {}), 1U);
}

TEST(DdsIncompatibleQos, is_reported_with_the_topic_and_the_policy) {
  std::ostringstream text;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "t", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  {
    const dds::Participant participant(testing::private_corner());
    dds::Writer<adstar_TorqueCommand> commands(participant);  // volatile
    const dds::Entity topic =
        dds::make_topic(participant, adstar_TorqueCommand_desc, "adstar/torque_command");
    const dds::QosHandle qos = dds::make_qos(dds::kLatest);
    const dds::Entity stricter(
        dds_create_reader(participant.subscriber(), topic.handle(), qos.get(), nullptr),
        "dds_create_reader", "test");
  }
  spdlog::set_default_logger(before);
  EXPECT_NE(text.str().find(
                "a reader on topic 'adstar/torque_command' does not match our writer: its QoS "
                "policy DURABILITY is incompatible"),
            std::string::npos)
      << text.str();
}

adstar_CommandStatus status_for(std::uint64_t commander) {
  adstar_CommandStatus status{};
  status.commander.low = commander;
  return status;
}

TEST(StatusWriter, ends_the_instances_of_silent_commanders) {
  const dds::Participant participant(testing::private_corner());
  dds::Reader<adstar_CommandStatus> reader(participant);
  bridge::StatusWriter writer(participant);
  const auto start = bridge::StatusWriter::Clock::now();
  writer.write(status_for(1), start);
  writer.write(status_for(2), start);
  writer.write(status_for(1), start + 30s);
  writer.forget_silent(60s, start + 61s);
  EXPECT_EQ(writer.instances(), 1U);
  std::set<std::uint64_t> gone;
  EXPECT_TRUE(eventually([&] {
    reader.take([](const auto&, const auto&) {},
                [&](const auto& key, const auto&) { gone.insert(key.commander.low); });
    return !gone.empty();
  }));
  EXPECT_EQ(gone, std::set<std::uint64_t>{2});
}

TEST(StatusWriter, keeps_a_bounded_number_of_instances) {
  const dds::Participant participant(testing::private_corner());
  bridge::StatusWriter writer(participant, 10);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    writer.write(status_for(i));
  }
  EXPECT_EQ(writer.instances(), 10U);
}

}  // namespace
}  // namespace adstar
