#include "service/bag/told.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace adstar::bag {
namespace {

namespace fs = std::filesystem;

std::optional<std::uint64_t> count_in(std::string_view text) {
  std::uint64_t count = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), count);
  return parsed.ec == std::errc{} ? std::optional(count) : std::nullopt;
}

/// A YAML scalar, in double quotes as metadata.cpp writes it, or plain as rosbag2 does.
std::string unquoted(std::string_view scalar) {
  if (scalar.size() < 2 || scalar.front() != '"' || scalar.back() != '"') {
    return std::string(scalar);
  }
  scalar = scalar.substr(1, scalar.size() - 2);
  std::string text;
  while (!scalar.empty()) {
    std::size_t taken = 1;
    char c = scalar.front();
    if (c == '\\' && scalar.size() > 1) {
      taken = 2;
      c = scalar[1] == 'n' ? '\n' : scalar[1];
      if (scalar[1] == 'x' && scalar.size() >= 4) {
        taken = 4;
        std::from_chars(scalar.data() + 2, scalar.data() + 4, c, 16);
      }
    }
    text += c;
    scalar.remove_prefix(taken);
  }
  return text;
}

/// Nothing is in it, or it is not there.
std::string absent(const fs::path& directory, const std::string& name) {
  std::error_code none;
  return fmt::format("{} {}", name, fs::exists(directory / name, none) ? "is empty" : "is missing");
}

/// A recorder counts from 0 and leaves no number out. What it never counts up to is another number, such as a date.
std::vector<std::string> gaps(const fs::path& directory, const std::vector<FileInfo>& there) {
  constexpr std::int64_t kLast = 100'000;
  std::vector<std::string> lacks;
  std::int64_t next = 0;
  for (const FileInfo& file : there) {
    const std::int64_t number = number_of(file.name);
    if (number < next || number > kLast) {
      continue;
    }
    const std::string name = file.name.substr(0, file.name.rfind('_'));
    for (; next < number; ++next) {
      lacks.push_back(absent(directory, fmt::format("{}_{}.db3", name, next)));
    }
    next = number + 1;
  }
  return lacks;
}

/// Of each file that was told of, whether it has its messages.
std::vector<std::string> lacking(const fs::path& directory, const Told& told,
                                 const std::vector<FileInfo>& there) {
  std::vector<std::string> lacks;
  for (const FileInfo& file : told.files) {
    const auto found = std::find_if(there.begin(), there.end(),
                                    [&](const FileInfo& f) { return f.name == file.name; });
    if (found == there.end() && file.messages > 0) {
      lacks.push_back(absent(directory, file.name));
    } else if (found != there.end() && found->messages < file.messages) {
      lacks.push_back(
          fmt::format("{} has {} of its {}", file.name, found->messages, file.messages));
    }
  }
  return lacks;
}

std::string listed(std::vector<std::string> lacks) {
  constexpr std::size_t kMost = 5;
  if (lacks.size() > kMost) {
    const std::string others = fmt::format("and {} more", lacks.size() - kMost);
    lacks.resize(kMost);
    lacks.push_back(others);
  }
  return fmt::format("{}", fmt::join(lacks, ", "));
}

constexpr const char* kRemedy = "this is what is left; bring the rest back if there is a copy";

}  // namespace

std::int64_t number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t bar = stem.rfind('_');
  std::int64_t number = -1;
  if (bar != std::string::npos) {
    std::from_chars(stem.data() + bar + 1, stem.data() + stem.size(), number);
  }
  return number;
}

std::optional<Told> told_of(const fs::path& directory) {
  constexpr std::string_view kAll = "  message_count: ", kFile = "    - path: ",
                             kOfFile = "      message_count: ";
  std::ifstream file(directory / kMetadataName);
  std::optional<std::uint64_t> all;
  Told told;
  for (std::string line; std::getline(file, line);) {
    const std::string_view text = line;
    if (text.starts_with(kAll)) {
      all = count_in(text.substr(kAll.size()));
    } else if (text.starts_with(kFile)) {
      FileInfo& told_file = told.files.emplace_back();
      told_file.name = fs::path(unquoted(text.substr(kFile.size()))).filename().string();
    } else if (text.starts_with(kOfFile) && !told.files.empty()) {
      told.files.back().messages = count_in(text.substr(kOfFile.size())).value_or(0);
    }
  }
  told.messages = all.value_or(0);
  return all ? std::optional(told) : std::nullopt;
}

std::string lost(const fs::path& directory, const std::optional<Told>& told,
                 const Metadata& there) {
  if (told && told->messages == there.messages()) {
    return {};  // whatever its files are called
  }
  const std::vector<std::string> lacks =
      told ? lacking(directory, *told, there.files) : gaps(directory, there.files);
  if (told && there.messages() < told->messages) {
    return fmt::format("'{}' has {} of the {} messages that its {} tells of{}{}; {}",
                       directory.string(), there.messages(), told->messages, kMetadataName,
                       lacks.empty() ? "" : ": ", listed(lacks), kRemedy);
  }
  if (lacks.empty()) {
    return {};
  }
  return fmt::format("'{}' has lost a part, by {}: {}; {}", directory.string(),
                     told ? "its metadata.yaml" : "the numbers of its files", listed(lacks),
                     kRemedy);
}

}  // namespace adstar::bag
