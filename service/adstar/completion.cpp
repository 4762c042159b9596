// adstar completion bash: a script made from the option tree, so that it cannot fall behind it.

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "adstar/integrators/all.hpp"
#include "service/adstar/failure.hpp"
#include "service/adstar/output.hpp"
#include "service/adstar/usage.hpp"
#include "service/adstar/verbs.hpp"
#include "service/scene/nearest.hpp"

namespace adstar::cli {
namespace {

std::string spaced(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

/// What may follow, by the type that the option tree gives the value.
std::string values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == "SCENE") {
    return "__scene";
  }
  if (type == "DIR") {
    return "__directory";
  }
  if (type == "FILE") {
    return "__file";
  }
  if (type == "SCHEME") {
    const auto names = scheme_names();
    return spaced({names.begin(), names.end()});
  }
  if (type == "bash" || type == "paper") {
    return type;
  }
  if (type.find('|') != std::string::npos) {
    std::string words = type;
    std::replace(words.begin(), words.end(), '|', ' ');
    return words;
  }
  return "";
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string verb_case(const CLI::App& verb) {
  std::string after_option, positional;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional()) {
      positional = values_of(*option);
    } else if (takes_value(*option)) {
      std::string names;
      for (const std::string& name : option->get_lnames()) {
        names += (names.empty() ? "--" : "|--") + name;
      }
      after_option +=
          fmt::format("        {}) values=\"{}\"; after=1 ;;\n", names, values_of(*option));
    }
  }
  return fmt::format(
      "    {})\n"
      "      options=\"{}\"\n"
      "      positional=\"{}\"\n"
      "      case \"$previous\" in\n{}"
      "      esac\n"
      "      ;;\n",
      verb.get_name(), spaced(option_words(verb)), positional, after_option);
}

constexpr const char* kBegin = R"(# bash completion for adstar; load it with
#   source <(adstar completion bash)
_adstar() {
  local current="${COMP_WORDS[COMP_CWORD]}" previous="${COMP_WORDS[COMP_CWORD-1]}"
  local options="" positional="" values="" after=0
)";

constexpr const char* kEnd = R"(  esac
  if [[ $after == 0 ]]; then
    if [[ $current == -* ]]; then values="$options"; else values="$positional"; fi
  fi
  case "$values" in
    __scene) compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.toml' -- "$current") ;;
    __directory) compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    __file) compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current") ;;
  esac
}
complete -F _adstar adstar
)";

std::string bash_script(const CLI::App& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* verb : verbs_of(program)) {
    names.push_back(verb->get_name());
    cases += verb_case(*verb);
  }
  return fmt::format(
      "{}"
      "  if [[ $COMP_CWORD == 1 ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"{} {}\" -- \"$current\")\n"
      "    return\n"
      "  fi\n"
      "  case \"${{COMP_WORDS[1]}}\" in\n{}{}",
      kBegin, spaced(names), spaced(option_words(program)), cases, kEnd);
}

}  // namespace

Verb add_completion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* verb = program.add_subcommand("completion", "Print a completion script for the shell");
  verb->add_option("shell", *shell, "The shell; bash is the one there is")
      ->type_name("bash")
      ->required()
      ->check(CLI::Validator(
          [](std::string& name) {
            return name == "bash" ? std::string()
                                  : fmt::format("got '{}', expected 'bash'; try bash", name);
          },
          ""));
  verb->footer("Example:\n  source <(adstar completion bash)");
  return {verb, [&program, shell] {
            Output output = Output::to_stdout();
            output.buffer() = bash_script(program);
            output.flush();
            return static_cast<int>(kDone);
          }};
}

}  // namespace adstar::cli
