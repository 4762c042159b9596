#pragma once
// Numbers as text: for machines exactly, for people readably.

#include <cstdint>
#include <string>

namespace adstar::report {

/// 17 significant digits, enough to get the same double back; "nan", "inf".
void append_number(std::string& text, double value);

/// Seconds, exactly: "0.01", "100".
void append_seconds(std::string& text, std::int64_t ns);
std::string seconds_text(std::int64_t ns);

/// "9,980"
std::string counted(std::uint64_t count);

/// Six significant digits, no more than it needs.
std::string short_number(double value);

}  // namespace adstar::report
