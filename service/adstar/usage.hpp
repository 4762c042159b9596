#pragma once
// Options that several verbs share, and how a wrong command line is said.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace adstar::cli {

/// A duration such as "100s", exact in nanoseconds; `allow_zero` for instants.
CLI::Option* add_duration(CLI::App& verb, const std::string& flags,
                          std::optional<std::int64_t>& value_ns, const std::string& description,
                          bool allow_zero = false);

/// The positional SCENE.
CLI::Option* add_scene(CLI::App& verb, std::string& file);

/// For check(): a whole number in that range.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// Names as DDS and scenes carry them.
CLI::Option* add_name(CLI::App& verb, const std::string& flags, std::string& name,
                      const std::string& description);

/// "adstar propagate: unknown option '--durtion'; did you mean '--duration'? ..."
std::string describe_usage_error(const CLI::App& program, const CLI::ParseError& error);

/// "--duration", "-h", ...: what a user may type.
std::vector<std::string> option_words(const CLI::App& verb);
std::vector<const CLI::App*> verbs_of(const CLI::App& program);

}  // namespace adstar::cli
