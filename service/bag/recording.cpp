#include "service/bag/recording.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "service/bag/directory_lock.hpp"
#include "service/bag/sqlite.hpp"
#include "service/bag/told.hpp"

namespace adstar::bag {
namespace {

namespace fs = std::filesystem;

/// False where a recorder was killed while it began the file: nothing is in it. Throws Error on a database of somebody
/// else, which stays as it is, and on a file that was cut short.
bool is_laid_out(const fs::path& file) {
  std::error_code none;
  if (fs::file_size(file, none) == 0) {
    return false;
  }
  const Database database(file, Database::Mode::look);
  Statement tables = database.prepare(
      "SELECT COUNT(*), COUNT(CASE WHEN type = 'table' AND name IN ('topics', 'messages') THEN 1 "
      "END) FROM sqlite_master");
  tables.step();
  if (tables.number(0) > 0 && tables.number(1) != 2) {
    throw Error(fmt::format(
        "'{}': there are no tables 'topics' and 'messages' in it, so it is no recording, and was "
        "left as it is; give the directory that `adstar record` made, or move this file out of it",
        file.string()));
  }
  database.require_whole_pages();
  return tables.number(1) == 2;
}

std::vector<fs::path> files_in(const fs::path& directory) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    if (entry.path().extension() == ".db3") {
      files.push_back(entry.path());
    }
  }
  if (error || files.empty()) {
    throw Error(fmt::format(
        "'{}': {}; expected the directory that `adstar record` made, with a "
        ".db3 file in it",
        directory.string(), error ? error.message() : std::string("there is no .db3 file in it")));
  }
  std::erase_if(files, [](const fs::path& file) { return !is_laid_out(file); });
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(number_of(a), a) < std::pair(number_of(b), b);
  });
  return files;
}

/// Calls read(first, last) for one stretch of rows after the other, and after each tells which part of the file has been read:
/// whoever wants few of the rows is told, too, and does not pass over all others at once.
template <class Read, class Tell>
void for_each_stretch(const Database& database, const Read& read, const Tell& tell) {
  constexpr std::int64_t kRows = 4096;
  Statement last = database.prepare("SELECT id FROM messages ORDER BY id DESC LIMIT 1");
  const std::int64_t last_row = last.step() ? last.number(0) : 0;
  for (std::int64_t read_to = 0; read_to < last_row;) {
    // Rows may be missing, and those that are there need not be close to each other.
    Statement next = database.prepare(
        fmt::format("SELECT id FROM messages WHERE id > {} ORDER BY id LIMIT 1", read_to));
    if (!next.step()) {
      return;  // somebody took the last ones away
    }
    const std::int64_t first_row = next.number(0);
    read_to = last_row - first_row < kRows ? last_row : first_row + kRows - 1;
    read(first_row, read_to);
    tell(static_cast<double>(read_to) / static_cast<double>(last_row));
  }
}

}  // namespace

Recording::Recording(const fs::path& directory)
    : directory_(directory), files_(files_in(directory)) {}

void Recording::for_each(const std::vector<std::string>& topics,
                         const std::function<void(const Message&)>& use) const {
  watcher_(0);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const Database database(files_[i], Database::Mode::open);
    std::map<std::int64_t, std::string> names;
    std::string wanted;
    Statement rows = database.prepare("SELECT id, name FROM topics");
    while (rows.step()) {
      if (std::find(topics.begin(), topics.end(), rows.text(1)) != topics.end()) {
        names.emplace(rows.number(0), rows.text(1));
        wanted += (wanted.empty() ? "" : ",") + std::to_string(rows.number(0));
      }
    }
    const auto read = [&](std::int64_t first_row, std::int64_t last_row) {
      Statement messages = database.prepare(
          fmt::format("SELECT topic_id, timestamp, data FROM messages WHERE id BETWEEN {} AND {} "
                      "AND topic_id IN ({}) ORDER BY id",
                      first_row, last_row, wanted));
      while (messages.step()) {
        use({names.at(messages.number(0)), messages.number(1), messages.bytes(2)});
      }
    };
    for_each_stretch(database, read, [&](double of_file) {
      const double part = (static_cast<double>(i) + of_file) / static_cast<double>(files_.size());
      if (part < 1) {
        watcher_(part);
      }
    });
  }
  watcher_(1);
}

Metadata Recording::count() const {
  Metadata metadata;
  for (const fs::path& path : files_) {
    const Database database(path, Database::Mode::open);
    FileInfo file;
    file.name = path.filename().string();
    Statement span =
        database.prepare("SELECT COUNT(*), MIN(timestamp), MAX(timestamp) FROM messages");
    span.step();
    file.messages = static_cast<std::uint64_t>(span.number(0));
    file.first_ns = span.number(1);
    file.last_ns = span.number(2);
    metadata.files.push_back(file);
    Statement topics = database.prepare(
        "SELECT name, type, offered_qos_profiles, COALESCE(n, 0) FROM topics LEFT JOIN "
        "(SELECT topic_id, COUNT(*) AS n FROM messages GROUP BY topic_id) ON topic_id = id "
        "ORDER BY id");
    while (topics.step()) {
      const TopicInfo topic{topics.text(0), topics.text(1), topics.text(2)};
      const auto known =
          std::find_if(metadata.topics.begin(), metadata.topics.end(),
                       [&](const TopicCount& t) { return t.topic.name == topic.name; });
      TopicCount& count = known != metadata.topics.end()
                              ? *known
                              : metadata.topics.emplace_back(TopicCount{topic, 0});
      count.messages += static_cast<std::uint64_t>(topics.number(3));
    }
  }
  return metadata;
}

Metadata Recording::messages_by_file() const {
  Metadata there;
  for (const fs::path& path : files_) {
    const Database database(path, Database::Mode::open);
    // Without its topics nobody can read a message.
    Statement messages = database.prepare(
        "SELECT CASE WHEN EXISTS (SELECT 1 FROM topics) "
        "THEN (SELECT COUNT(*) FROM messages) ELSE 0 END");
    messages.step();
    FileInfo& file = there.files.emplace_back();
    file.name = path.filename().string();
    file.messages = static_cast<std::uint64_t>(messages.number(0));
  }
  return there;
}

Recording::Ending Recording::ending() const {
  const DirectoryLock lock(directory_, DirectoryLock::Kind::mender);
  // A recorder that has ended since this was opened may have begun files that are not among these.
  if (lock.refused() || files_in(directory_) != files_) {
    return Ending::still_recorded;
  }
  leave_logs();
  const auto told = told_of(directory_);
  const Metadata there = messages_by_file();
  if (!bag::lost(directory_, told, there).empty()) {
    return Ending::incomplete;
  }
  return told && told->messages == there.messages() ? Ending::ended : Ending::cut_off;
}

std::string Recording::lost() const {
  return bag::lost(directory_, told_of(directory_), messages_by_file());
}

void Recording::leave_logs() const {
  for (const fs::path& path : files_) {
    try {
      Database(path, Database::Mode::open).leave_log();
    } catch (const Error&) {
      // Whoever reads it next says what is wrong.
    }
  }
}

bool Recording::mend() const {
  const DirectoryLock lock(directory_, DirectoryLock::Kind::mender);
  if (ending() != Ending::cut_off) {
    return false;
  }
  const Metadata metadata = count();
  try {
    write_metadata(metadata, directory_);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace adstar::bag
