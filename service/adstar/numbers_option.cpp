#include "service/adstar/numbers_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace adstar::cli {
namespace {

std::optional<std::vector<double>> parse(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number)) {
      return std::nullopt;
    }
    numbers.push_back(number);
    if (after == end) {
      return numbers;
    }
    if (*after != ',') {
      return std::nullopt;
    }
    at = after + 1;
  }
}

}  // namespace

CLI::Option* add_numbers(CLI::App& verb, const std::string& flags, std::vector<double>& numbers,
                         const std::vector<std::size_t>& counts, const std::string& type,
                         const std::string& description, const std::string& example) {
  return verb
      .add_option_function<std::string>(
          flags, [&numbers](const std::string& text) { numbers = *parse(text); }, description)
      ->type_name(type)
      ->check(CLI::Validator(
          [counts, type, example](std::string& text) {
            const auto read = parse(text);
            const bool good =
                read && std::find(counts.begin(), counts.end(), read->size()) != counts.end();
            return good ? std::string()
                        : fmt::format("got '{}', expected numbers {} without blanks; try {}", text,
                                      type, example);
          },
          ""));
}

}  // namespace adstar::cli
