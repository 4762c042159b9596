#include "service/bag/metadata.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <optional>
#include <unistd.h>

#include <fmt/format.h>

#include "service/bag/sqlite.hpp"

namespace adstar::bag {
namespace {

/// A YAML scalar in double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < ' ') {
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

std::uint64_t Metadata::messages() const {
  return std::accumulate(files.begin(), files.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const FileInfo& f) { return sum + f.messages; });
}

std::int64_t Metadata::first_ns() const {
  std::optional<std::int64_t> first;
  for (const FileInfo& file : files) {
    if (file.messages > 0) {
      first = std::min(first.value_or(file.first_ns), file.first_ns);
    }
  }
  return first.value_or(0);
}

std::int64_t Metadata::last_ns() const {
  std::optional<std::int64_t> last;
  for (const FileInfo& file : files) {
    if (file.messages > 0) {
      last = std::max(last.value_or(file.last_ns), file.last_ns);
    }
  }
  return last.value_or(0);
}

std::string to_yaml(const Metadata& m) {
  std::string text = fmt::format(
      "rosbag2_bagfile_information:\n"
      "  version: 5\n"
      "  storage_identifier: sqlite3\n"
      "  duration:\n"
      "    nanoseconds: {}\n"
      "  starting_time:\n"
      "    nanoseconds_since_epoch: {}\n"
      "  message_count: {}\n",
      m.last_ns() - m.first_ns(), m.first_ns(), m.messages());
  text += m.topics.empty() ? "  topics_with_message_count: []\n" : "  topics_with_message_count:\n";
  for (const TopicCount& t : m.topics) {
    text += fmt::format(
        "    - topic_metadata:\n"
        "        name: {}\n"
        "        type: {}\n"
        "        serialization_format: cdr\n"
        "        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        t.topic.name, t.topic.type, quoted(t.topic.offered_qos), t.messages);
  }
  text +=
      "  compression_format: \"\"\n"
      "  compression_mode: \"\"\n"
      "  relative_file_paths:\n";
  for (const FileInfo& file : m.files) {
    text += fmt::format("    - {}\n", quoted(file.name));
  }
  text += "  files:\n";
  for (const FileInfo& file : m.files) {
    text += fmt::format(
        "    - path: {}\n"
        "      starting_time:\n"
        "        nanoseconds_since_epoch: {}\n"
        "      duration:\n"
        "        nanoseconds: {}\n"
        "      message_count: {}\n",
        quoted(file.name), file.first_ns, file.last_ns - file.first_ns, file.messages);
  }
  return text;
}

void write_metadata(const Metadata& metadata, const std::filesystem::path& directory) {
  const auto target = directory / kMetadataName;
  const auto part = directory / fmt::format(".{}.{}.part", kMetadataName, getpid());
  bool written = false;
  {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out << to_yaml(metadata);
    out.flush();
    written = static_cast<bool>(out);
  }
  std::error_code renamed;
  if (written) {
    std::filesystem::rename(part, target, renamed);
  }
  if (!written || renamed) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error(
        fmt::format("cannot write '{}'; make room, or choose a directory that you may write to",
                    target.string()));
  }
}

}  // namespace adstar::bag
