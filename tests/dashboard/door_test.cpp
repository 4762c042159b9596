#include "service/dashboard/server/door.hpp"

#include <gtest/gtest.h>

namespace adstar::dashboard {
namespace {

constexpr int kPort = 8765;

Provenance own_page() { return {"127.0.0.1:8765", "http://127.0.0.1:8765", "same-origin", "cors"}; }

TEST(Door, answers_its_own_page_under_each_of_its_names) {
  EXPECT_EQ(why_not_answered(own_page(), kPort), "");
  EXPECT_EQ(why_not_answered({"localhost:8765", "", "", ""}, kPort), "");
  EXPECT_EQ(why_not_answered({"LocalHost:8765", "http://localhost:8765", "", ""}, kPort), "");
  EXPECT_EQ(why_not_answered({"[::1]:8765", "", "", ""}, kPort), "");
}

TEST(Door, refuses_another_host_as_a_rebound_name_would_be) {
  for (const char* host : {"example.org:8765", "127.0.0.1", "127.0.0.1:80", "",
                           "127.0.0.1:8765.example.org", "127.0.0.1.example.org:8765"}) {
    EXPECT_NE(why_not_answered({host, "", "", ""}, kPort), "") << host;
  }
}

TEST(Door, refuses_another_origin_and_says_which) {
  Provenance request = own_page();
  for (const char* origin : {"http://example.org", "https://127.0.0.1:8765",
                             "http://127.0.0.1:8766", "http://localhost:8765", "null"}) {
    request.origin = origin;
    EXPECT_NE(why_not_answered(request, kPort).find(origin), std::string::npos) << origin;
  }
}

TEST(Door, lets_a_link_in_but_no_script_of_another_site) {
  EXPECT_EQ(why_not_answered({"127.0.0.1:8765", "", "cross-site", "navigate"}, kPort), "");
  EXPECT_NE(why_not_answered({"127.0.0.1:8765", "", "cross-site", "no-cors"}, kPort), "");
  EXPECT_NE(why_not_answered({"127.0.0.1:8765", "", "same-site", "cors"}, kPort), "");
}

TEST(Door, lets_nobody_command_a_dashboard_that_only_shows) {
  EXPECT_NE(
      why_not_commanded(own_page(), "application/json", kPort, false).find("--allow-commands"),
      std::string::npos);
}

TEST(Door, lets_its_own_page_command_in_json_alone) {
  EXPECT_EQ(why_not_commanded(own_page(), "application/json", kPort, true), "");
  EXPECT_EQ(why_not_commanded(own_page(), "Application/JSON; charset=utf-8", kPort, true), "");
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded",
                           "multipart/form-data; boundary=application/json"}) {
    EXPECT_NE(why_not_commanded(own_page(), type, kPort, true), "") << type;
  }
}

TEST(Door, wants_to_know_the_origin_of_a_command) {
  Provenance request = own_page();
  request.origin.clear();
  EXPECT_NE(why_not_commanded(request, "application/json", kPort, true).find("Origin"),
            std::string::npos);
}

}  // namespace
}  // namespace adstar::dashboard
