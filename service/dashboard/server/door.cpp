#include "service/dashboard/server/door.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace adstar::dashboard {
namespace {

constexpr std::array<std::string_view, 3> kOurNames{"127.0.0.1", "localhost", "[::1]"};

std::string lower(std::string_view text) {
  std::string low(text);
  std::transform(low.begin(), low.end(), low.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return low;
}

bool is_our_host(std::string_view host, int port) {
  const std::string low = lower(host);
  return std::any_of(kOurNames.begin(), kOurNames.end(), [&](std::string_view name) {
    return low == fmt::format("{}:{}", name, port) || (port == 80 && low == name);
  });
}

bool is_our_origin(std::string_view origin, std::string_view host) {
  return lower(origin) == "http://" + lower(host);
}

}  // namespace

std::string why_not_answered(const Provenance& request, int port) {
  if (!is_our_host(request.host, port)) {
    return fmt::format(
        "refused: Host is '{}', expected 127.0.0.1:{} or localhost:{}; through a tunnel, use the "
        "same "
        "port on both ends",
        request.host, port, port);
  }
  if (!request.origin.empty() && !is_our_origin(request.origin, request.host)) {
    return fmt::format("refused: Origin is '{}', expected http://{}; open the dashboard's own page",
                       request.origin, request.host);
  }
  // A link on another site may lead here; its scripts, frames and images may not ask.
  const bool foreign = request.fetch_site == "cross-site" || request.fetch_site == "same-site";
  if (foreign && request.fetch_mode != "navigate") {
    return fmt::format("refused: a page of another site asks (Sec-Fetch-Site: {})",
                       request.fetch_site);
  }
  return {};
}

std::string why_not_commanded(const Provenance& request, std::string_view content_type, int port,
                              bool commands_allowed) {
  if (std::string why = why_not_answered(request, port); !why.empty()) {
    return why;
  }
  if (!commands_allowed) {
    return "refused: this dashboard only shows; start it with --allow-commands to command";
  }
  if (request.origin.empty()) {
    return fmt::format("refused: no Origin, expected http://{}; use the page, or `adstar torque`",
                       request.host);
  }
  const std::string type = lower(content_type.substr(0, content_type.find(';')));
  if (type != "application/json") {
    return fmt::format("refused: Content-Type is '{}', expected application/json", content_type);
  }
  return {};
}

}  // namespace adstar::dashboard
