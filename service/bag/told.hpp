#pragma once
// What a recording should have, and what it lacks of it: by its metadata.yaml, or, where there is none, by the numbers
// of its files.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/bag/metadata.hpp"

namespace adstar::bag {

/// NAME_12.db3: 12; what has no number comes first.
std::int64_t number_of(const std::filesystem::path& file);

/// What metadata.yaml says is there.
struct Told {
  std::uint64_t messages = 0;
  std::vector<FileInfo> files;  ///< name and messages alone
};

/// Nothing where there is no metadata.yaml, or one without a count of messages.
std::optional<Told> told_of(const std::filesystem::path& directory);

/// "'runs/monday' has 176 of the 204 messages that its metadata.yaml tells of: monday_1.db3 is missing; ...": a sentence for
/// the user. Empty when nothing is known to be lost.
/// `there`: the files in the order of their numbers, names and messages alone.
std::string lost(const std::filesystem::path& directory, const std::optional<Told>& told,
                 const Metadata& there);

}  // namespace adstar::bag
