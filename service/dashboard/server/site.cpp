#include "service/dashboard/server/site.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <sys/socket.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "service/adstar/failure.hpp"
#include "service/dashboard/server/door.hpp"
#include "service/dashboard/server/frame_json.hpp"
#include "service/dashboard/server/limited_server.hpp"
#include "service/dashboard/server/metrics_text.hpp"
#include "service/dashboard/server/page.hpp"
#include "service/dds/error.hpp"

namespace adstar::dashboard {
namespace {

using namespace std::chrono_literals;

constexpr auto kFramePeriod = 100ms;
constexpr int kMostStreams = 12;
/// A stream holds a thread as long as it lasts; the rest answer short questions.
constexpr std::size_t kThreads = kMostStreams + 6;
constexpr std::size_t kLongestBody = 4096;
constexpr const char* kText = "text/plain; charset=utf-8";
constexpr const char* kJson = "application/json";
constexpr const char* kWithoutPage =
    "This adstar was built without the page: npm or its registry was out of reach, or "
    "ADSTAR_BUILD_DASHBOARD was OFF.\n"
    "/events, /fleet and /metrics are served. For the page, install nodejs and npm, configure "
    "with\n"
    "-DADSTAR_BUILD_DASHBOARD=ON and build again: what is missing is then said.\n";

Provenance provenance_of(const httplib::Request& request) {
  return {request.get_header_value("Host"), request.get_header_value("Origin"),
          request.get_header_value("Sec-Fetch-Site"), request.get_header_value("Sec-Fetch-Mode")};
}

httplib::Headers security_headers() {
  return {{"Content-Security-Policy", kContentPolicy},
          {"X-Content-Type-Options", "nosniff"},
          {"X-Frame-Options", "DENY"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", kText);
}

/// Where no handler has said it.
std::string why_not_served(int status, const std::string& path) {
  switch (status) {
    case 404:
      return fmt::format("404: nothing at {}; see /, /events, /fleet, /metrics",
                         path.substr(0, 200));
    case 413:
      return fmt::format("413: too long; a request has {} bytes of body at most", kLongestBody);
    default:
      return fmt::format("{}: not a request that is served here; see /", status);
  }
}

std::string answer_json(const char* verdict, const std::string& sentence) {
  return nlohmann::json{{"verdict", verdict}, {"sentence", sentence}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Site::Site(const Bus& bus, PulseDesk& desk, Options options)
    : bus_(bus),
      desk_(desk),
      options_(std::move(options)),
      server_(std::make_unique<LimitedServer>(ending_, kThreads)) {
  // The library would share the port with a second dashboard (SO_REUSEPORT).
  server_->set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server_->set_default_headers(security_headers());
  server_->set_payload_max_length(kLongestBody);
  server_->set_tcp_nodelay(true);
  server_->set_pre_routing_handler([this](const auto& request, auto& response) {
    const std::string why = why_not_answered(provenance_of(request), options_.port);
    if (why.empty()) {
      return httplib::Server::HandlerResponse::Unhandled;
    }
    refuse(response, 403, why);
    return httplib::Server::HandlerResponse::Handled;
  });
  server_->set_error_handler([](const auto& request, auto& response) {
    if (!response.body.empty()) {
      return;
    }
    const std::string why = why_not_served(response.status, request.path);
    if (request.method == "POST" && request.path == "/command") {
      response.set_content(answer_json("not_sent", why), kJson);
    } else {
      refuse(response, response.status, why);
    }
  });
  add_page();
  add_data();
  errno = 0;
  const int bound = options_.port == 0 ? server_->bind_to_any_port("127.0.0.1")
                    : server_->bind_to_port("127.0.0.1", options_.port) ? options_.port
                                                                        : -1;
  if (bound <= 0) {
    throw cli::Failure(cli::kFailed,
                       fmt::format("cannot listen on 127.0.0.1:{}: {}; choose another --port, or 0 "
                                   "for any that is free",
                                   options_.port, errno == 0 ? "refused" : std::strerror(errno)));
  }
  options_.port = bound;
  server_->lengthen_queue();
  thread_ = std::thread([this] {
    server_->listen_after_bind();
    ended_ = true;
  });
}

Site::~Site() {
  ending_ = true;
  // stop() does nothing to a server that has not begun yet.
  while (!server_->is_running() && !ended_) {
    std::this_thread::sleep_for(1ms);
  }
  server_->stop();
  thread_.join();
}

void Site::add_page() {
  for (const PageFile& file : page_files()) {
    const auto serve = [file](const httplib::Request&, httplib::Response& response) {
      response.set_content(file.bytes.data(), file.bytes.size(), std::string(file.content_type));
    };
    server_->Get(std::string(file.path), serve);
    if (file.path == "/index.html") {
      server_->Get("/", serve);
    }
  }
  if (page_files().empty()) {
    server_->Get("/",
                 [](const auto&, auto& response) { response.set_content(kWithoutPage, kText); });
  }
}

void Site::add_data() {
  server_->Get("/events",
               [this](const auto& request, auto& response) { stream(request, response); });
  server_->Get("/fleet", [this](const auto&, auto& response) {
    response.set_content(bus_.with_board([](const Board& board) { return fleet_json(board); }),
                         kJson);
  });
  server_->Get("/about", [this](const auto&, auto& response) {
    response.set_content(
        nlohmann::json{{"commands_allowed", options_.allow_commands}, {"place", options_.place}}
            .dump(),
        kJson);
  });
  server_->Get("/metrics", [this](const auto&, auto& response) {
    response.set_content(
        bus_.with_board([](const Board& board) { return metrics_text(board, Clock::now()); }),
        "text/plain; version=0.0.4; charset=utf-8");
  });
  server_->Post("/command",
                [this](const auto& request, auto& response) { command(request, response); });
}

void Site::stream(const httplib::Request& request, httplib::Response& response) {
  if (++streams_ > kMostStreams) {
    --streams_;
    refuse(response, 503, fmt::format("{} pages follow already; close one", kMostStreams));
    return;
  }
  struct Progress {
    std::uint64_t last_verdict = 0;
    Clock::time_point due = Clock::now();
  };
  const auto progress = std::make_shared<Progress>();
  const std::string watched = request.get_param_value("spacecraft");
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, progress, watched](std::size_t, httplib::DataSink& sink) {
        std::this_thread::sleep_until(progress->due);
        if (ending_) {
          return false;
        }
        progress->due = std::max(progress->due + kFramePeriod, Clock::now());
        std::uint64_t newest = 0;
        const std::string frame = bus_.with_board([&](const Board& board) {
          newest = board.verdicts().empty() ? 0 : board.verdicts().back().number;
          return frame_json(board, watched, progress->last_verdict, Clock::now());
        });
        progress->last_verdict = newest;
        const std::string event = "data: " + frame + "\n\n";
        return sink.write(event.data(), event.size());
      },
      [this](bool) { --streams_; });
}

void Site::command(const httplib::Request& request, httplib::Response& response) {
  const std::string why =
      why_not_commanded(provenance_of(request), request.get_header_value("Content-Type"),
                        options_.port, options_.allow_commands);
  if (!why.empty()) {
    response.status = 403;
    response.set_content(answer_json("not_sent", why), kJson);
    return;
  }
  try {
    const PulseAnswer answer = desk_.send(pulse_of(request.body));
    response.status = answer.http_status;
    response.set_content(answer.json, kJson);
  } catch (const std::invalid_argument& error) {
    response.status = 400;
    response.set_content(answer_json("not_sent", error.what()), kJson);
  } catch (const dds::NotAllowed& error) {
    response.status = 403;
    response.set_content(answer_json("not_sent", error.what()), kJson);
  } catch (const std::exception& error) {
    response.status = 500;
    response.set_content(answer_json("not_sent", error.what()), kJson);
  }
}

}  // namespace adstar::dashboard
