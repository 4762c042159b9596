// The server against clients that take their time.

#include "service/dashboard/server/site.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/dashboard/http_client.hpp"

namespace adstar::dashboard {
namespace {

using namespace std::chrono_literals;
using testing::HttpClient;

/// A server on a bus where nobody speaks.
struct Served {
  dds::Participant participant{{87, "lo", "site-test-" + std::to_string(getpid())}};
  Bus bus{participant};
  PulseDesk desk{participant};
  std::optional<Site> site;
  int port = 0;

  explicit Served(bool allow_commands = false) {
    site.emplace(bus, desk, Site::Options{0, allow_commands, "here"});
    port = site->port();
  }
};

std::string answer_to(int port, const std::string& path, const std::string& more_head = "") {
  const HttpClient client(port);
  client.say("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" +
             more_head + "\r\n");
  return client.hear();
}

/// Clients that send a byte of their head every now and then, until they lose patience or are no longer wanted.
class Dripping {
 public:
  Dripping(int port, int clients) {
    for (int i = 0; i < clients; ++i) {
      clients_.push_back(std::make_unique<HttpClient>(port));
      clients_.back()->say("GET /");
    }
    thread_ = std::thread([this] {
      const auto ends = std::chrono::steady_clock::now() + 20s;
      while (!unwanted_ && std::chrono::steady_clock::now() < ends) {
        for (const auto& client : clients_) {
          client->say("a");
        }
        std::this_thread::sleep_for(50ms);
      }
      gave_up_ = !unwanted_;
      clients_.clear();
    });
  }
  ~Dripping() {
    unwanted_ = true;
    thread_.join();
  }
  bool gave_up() const { return gave_up_; }

 private:
  std::vector<std::unique_ptr<HttpClient>> clients_;
  std::atomic<bool> unwanted_ = false, gave_up_ = false;
  std::thread thread_;
};

TEST(Site, ends_though_a_client_still_sends_its_head) {
  Served served;
  const Dripping dripping(served.port, 1);
  ASSERT_NE(answer_to(served.port, "/about").find("200 OK"),
            std::string::npos);  // so that one is in
  served.site.reset();
  EXPECT_FALSE(dripping.gave_up());
}

TEST(Site, answers_though_slow_clients_held_every_thread) {
  Served served;
  const Dripping dripping(served.port, 20);
  EXPECT_NE(answer_to(served.port, "/metrics").find("200 OK"), std::string::npos);
  EXPECT_FALSE(dripping.gave_up());
}

TEST(Site, lets_those_go_together_who_waited_for_a_thread_in_vain) {
  Served served;
  const Dripping dripping(served.port, 200);
  EXPECT_NE(answer_to(served.port, "/metrics").find("200 OK"), std::string::npos);
  EXPECT_FALSE(dripping.gave_up());
}

TEST(Site, reads_all_of_a_head_that_waited_for_a_thread) {
  Served served;
  const Dripping dripping(served.port, 200);
  const std::string longer_than_a_read = "Cookie: " + std::string(5000, 'c') + "\r\n";
  EXPECT_NE(answer_to(served.port, "/metrics", longer_than_a_read).find("200 OK"),
            std::string::npos);
  EXPECT_FALSE(dripping.gave_up());
}

TEST(Site, reads_no_second_request_on_a_connection) {
  const Served served;
  const std::string request =
      "GET /about HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) + "\r\n\r\n";
  const HttpClient client(served.port);
  client.say(request + request);
  const std::string heard = client.hear();
  const std::size_t first = heard.find("HTTP/1.1 200 OK");
  EXPECT_EQ(first, 0U) << heard;
  EXPECT_EQ(heard.find("HTTP/1.1", first + 1), std::string::npos) << heard;
}

TEST(Site, tells_a_command_that_is_too_long_so_in_the_form_that_the_page_reads) {
  const Served served(true);
  const HttpClient client(served.port);
  client.say("POST /command HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) +
             "\r\nContent-Type: application/json\r\nContent-Length: 5000\r\n\r\n" +
             std::string(5000, ' '));
  const std::string heard = client.hear();
  for (const char* part : {"HTTP/1.1 413 ", "Content-Type: application/json",
                           R"("verdict":"not_sent")", "4096 bytes"}) {
    EXPECT_NE(heard.find(part), std::string::npos) << part << " in " << heard;
  }
  EXPECT_EQ(heard.find("nothing at"), std::string::npos) << heard;
}

TEST(Site, says_where_there_is_nothing_and_what_there_is) {
  const Served served;
  const std::string heard = answer_to(served.port, "/nowhere");
  EXPECT_NE(heard.find("HTTP/1.1 404 "), std::string::npos) << heard;
  EXPECT_NE(heard.find("404: nothing at /nowhere; see /, /events"), std::string::npos) << heard;
}

}  // namespace
}  // namespace adstar::dashboard
