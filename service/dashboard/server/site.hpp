#pragma once
// The HTTP server, on loopback alone:
//
//   GET  /         the page and its files
//   GET  /events   server-sent events: frame_json() ten times a second; ?spacecraft=NAME
//   GET  /fleet    fleet_json()
//   GET  /metrics  metrics_text()
//   POST /command  a torque pulse (pulse.hpp), where commands are allowed
//
// A slow reader of /events misses frames: each is made when there is room for it, none waits. Whoever does not
// finish a request, or takes nothing of its answer, is let go.

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "service/dashboard/server/bus.hpp"
#include "service/dashboard/server/pulse.hpp"

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace adstar::dashboard {

class LimitedServer;

class Site {
 public:
  struct Options {
    int port = 0;  ///< 0: any that is free
    bool allow_commands = false;
    std::string place;  ///< of the bus, in words, for the page
  };

  /// Serves from then on. Throws cli::Failure when the port cannot be had.
  Site(const Bus& bus, PulseDesk& desk, Options options);
  /// Ends at once, whatever its clients do.
  ~Site();
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  int port() const { return options_.port; }

 private:
  void add_page();
  void add_data();
  void stream(const httplib::Request& request, httplib::Response& response);
  void command(const httplib::Request& request, httplib::Response& response);

  const Bus& bus_;
  PulseDesk& desk_;
  Options options_;
  std::atomic<bool> ending_ = false;  ///< streams are to end
  std::atomic<bool> ended_ = false;   ///< the server listens no more
  std::atomic<int> streams_ = 0;
  std::unique_ptr<LimitedServer> server_;
  std::thread thread_;
};

}  // namespace adstar::dashboard
