#pragma once
// Who may come in: the server is on loopback, but so is every page that the user's browser shows.
//
// A page of another site can send requests here (its Origin tells), and a name of another site can
// be made to resolve to 127.0.0.1 (its Host tells). Neither is answered.

#include <string>
#include <string_view>

namespace adstar::dashboard {

/// What of a request's head says where it comes from; empty: the field is missing.
struct Provenance {
  std::string host;
  std::string origin;
  std::string fetch_site;  ///< Sec-Fetch-Site
  std::string fetch_mode;  ///< Sec-Fetch-Mode
};

/// Empty when the request may be answered, else why not and what to do.
std::string why_not_answered(const Provenance& request, int port);

/// The same for a command, which must say that it comes from our own page, or pretend to, and be of
/// a type that no form of another site can send.
std::string why_not_commanded(const Provenance& request, std::string_view content_type, int port,
                              bool commands_allowed);

/// Content-Security-Policy of every answer.
inline constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
    "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace adstar::dashboard
