#include "service/adstar/usage.hpp"

#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "service/scene/keys.hpp"
#include "service/scene/nearest.hpp"
#include "service/scene/scene.hpp"

namespace adstar::cli {
namespace {

std::vector<std::string_view> views(const std::vector<std::string>& words) {
  return {words.begin(), words.end()};
}

std::string did_you_mean(std::string_view typed, const std::vector<std::string>& known) {
  const auto near = scene::nearest_plausible(typed, views(known));
  return near ? fmt::format("; did you mean '{}'?", *near) : std::string();
}

/// The verb that was being parsed, or the program itself.
const CLI::App& parsed_verb(const CLI::App& program) {
  for (const CLI::App* verb : verbs_of(program)) {
    if (verb->parsed()) {
      return *verb;
    }
  }
  return program;
}

std::string verb_names(const CLI::App& program) {
  std::string text;
  for (const CLI::App* verb : verbs_of(program)) {
    text += (text.empty() ? "" : ", ") + verb->get_name();
  }
  return text;
}

std::string unknown_word(const CLI::App& program, const CLI::App& verb) {
  const std::vector<std::string> rest = program.remaining(true);
  const std::string word = rest.empty() ? std::string() : rest.front();
  if (word.starts_with('-') && &verb == &program) {
    return fmt::format("unknown option '{}'; options come after their verb", word);
  }
  if (word.starts_with('-')) {
    return fmt::format("unknown option '{}'{}", word, did_you_mean(word, option_words(verb)));
  }
  if (&verb != &program) {
    return fmt::format("'{}' is one word too many", word);
  }
  std::vector<std::string> names;
  for (const CLI::App* known : verbs_of(program)) {
    names.push_back(known->get_name());
  }
  const std::string suggestion = did_you_mean(word, names);
  return fmt::format("unknown verb '{}'{}", word,
                     suggestion.empty() ? "; expected one of " + verb_names(program) : suggestion);
}

/// "Could not convert: --priority = x" in our own form.
std::string conversion_text(const std::string& what) {
  const std::size_t colon = what.find(": "), equals = what.find(" = ");
  if (colon == std::string::npos || equals == std::string::npos || equals < colon) {
    return what;
  }
  return fmt::format("{}: got '{}', expected a number", what.substr(colon + 2, equals - colon - 2),
                     what.substr(equals + 3));
}

}  // namespace

CLI::Option* add_duration(CLI::App& verb, const std::string& flags,
                          std::optional<std::int64_t>& value_ns, const std::string& description,
                          bool allow_zero) {
  return verb
      .add_option_function<std::string>(
          flags, [&value_ns](const std::string& text) { value_ns = scene::parse_duration(text); },
          description)
      ->type_name("DURATION")
      ->check(CLI::Validator(
          [allow_zero](std::string& text) -> std::string {
            const auto ns = scene::parse_duration(text);
            if (!ns) {
              return fmt::format(
                  "got '{}', expected a duration in whole nanoseconds; try {}", text,
                  scene::parse_duration(text + "s") ? "'" + text + "s'" : "'10ms', '1.5s' or '2h'");
            }
            return *ns > 0 || allow_zero
                       ? std::string()
                       : fmt::format("got '{}', expected more than zero; try '1s'", text);
          },
          ""));
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto refuse = [least, most](std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool good =
        error == std::errc{} && end == text.data() + text.size() && value >= least && value <= most;
    const std::string range = most == std::numeric_limits<std::uint64_t>::max()
                                  ? fmt::format("{} or more", least)
                                  : fmt::format("{} to {}", least, most);
    return good ? std::string()
                : fmt::format("got '{}', expected a whole number, {}; try {}", text, range, least);
  };
  return {refuse, ""};
}

CLI::Option* add_scene(CLI::App& verb, std::string& file) {
  return verb.add_option("scene", file, "The scene file (TOML)")->type_name("SCENE")->required();
}

CLI::Option* add_name(CLI::App& verb, const std::string& flags, std::string& name,
                      const std::string& description) {
  return verb.add_option(flags, name, description)
      ->type_name("NAME")
      ->check(CLI::Validator(
          [](std::string& text) {
            return scene::is_name(text) ? std::string()
                                        : fmt::format("got '{}', expected {}; try '{}'", text,
                                                      scene::kNameRule, scene::as_name(text));
          },
          ""));
}

std::string describe_usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& verb = parsed_verb(program);
  const bool in_verb = &verb != &program;
  std::string what = error.what();
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    what = conversion_text(what);
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
             (!in_verb && !program.remaining(true).empty())) {
    what = unknown_word(program, verb);
  } else if (!in_verb) {
    what = "a verb is missing; expected one of " + verb_names(program);
  }
  const std::string command = in_verb ? "adstar " + verb.get_name() : "adstar";
  return fmt::format("{}: {}\nSee '{} --help'.", command, what, command);
}

std::vector<std::string> option_words(const CLI::App& verb) {
  std::vector<std::string> words;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      words.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      words.push_back("-" + name);
    }
  }
  return words;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

}  // namespace adstar::cli
