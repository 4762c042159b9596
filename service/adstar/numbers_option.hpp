#pragma once
// An option that takes a few numbers in one word: "1,0,0,0".

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace adstar::cli {

/// One of `counts` finite numbers; nothing else is let through.
CLI::Option* add_numbers(CLI::App& verb, const std::string& flags, std::vector<double>& numbers,
                         const std::vector<std::size_t>& counts, const std::string& type,
                         const std::string& description, const std::string& example);

}  // namespace adstar::cli
