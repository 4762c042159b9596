#include "service/report/fields.hpp"

#include "service/report/numbers.hpp"

namespace adstar::report {
namespace {

struct Appended {
  std::string& text;

  void operator()(const std::string& word) const { append_csv_word(text, word); }
  void operator()(std::uint64_t count) const { text += std::to_string(count); }
  void operator()(Seconds time) const { append_seconds(text, time.ns); }
  void operator()(double number) const { append_number(text, number); }
  void operator()(Unknown) const {}
};

}  // namespace

void append_csv_word(std::string& text, std::string_view word) {
  for (const char c : word) {
    const bool plain = c > ' ' && c != ',' && c != '"' && c != '\x7f';
    text += plain ? c : '?';
  }
}

void append_csv(std::string& text, const Fields& fields) {
  bool first = true;
  for (const Field& field : fields.all()) {
    if (!first) {
      text += ',';
    }
    first = false;
    std::visit(Appended{text}, field);
  }
  text += '\n';
}

}  // namespace adstar::report
