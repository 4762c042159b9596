#include "service/bag/file_writer.hpp"

#include <algorithm>
#include <string_view>

namespace adstar::bag {

FileWriter::FileWriter(const std::filesystem::path& file, const std::vector<TopicInfo>& topics)
    : database_(file, Database::Mode::make) {
  info_.name = file.filename().string();
  database_.run("PRAGMA journal_mode=WAL");
  // A power cut may take what was committed last; a kill takes nothing of it.
  database_.run("PRAGMA synchronous=NORMAL");
  database_.run("BEGIN");
  database_.run(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  database_.run(
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  database_.run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  Statement insert = database_.prepare(
      "INSERT INTO topics (name, type, serialization_format, offered_qos_profiles) "
      "VALUES (?, ?, 'cdr', ?)");
  for (const TopicInfo& topic : topics) {
    insert.bind(1, std::string_view(topic.name))
        .bind(2, std::string_view(topic.type))
        .bind(3, std::string_view(topic.offered_qos))
        .run();
    topic_rows_.push_back(database_.last_row());
  }
  database_.run("COMMIT");
  insert_.push_back(
      database_.prepare("INSERT INTO messages (timestamp, topic_id, data) VALUES (?, ?, ?)"));
  committed_bytes_ = measured_bytes();
}

void FileWriter::add(std::size_t topic, std::int64_t received_ns,
                     std::span<const std::byte> payload) {
  if (!in_transaction_) {
    database_.run("BEGIN");
    in_transaction_ = true;
  }
  insert_.front().bind(1, received_ns).bind(2, topic_rows_.at(topic)).bind(3, payload).run();
  info_.first_ns = info_.messages == 0 ? received_ns : std::min(info_.first_ns, received_ns);
  info_.last_ns = info_.messages == 0 ? received_ns : std::max(info_.last_ns, received_ns);
  ++info_.messages;
  // Pages are not filled to the brim: rather too much, for then a commit shows how much it is.
  constexpr std::uint64_t kRowAndIndex = 32;
  pending_bytes_ += (payload.size() + kRowAndIndex) * 5 / 4;
}

void FileWriter::commit() {
  if (in_transaction_) {
    database_.run("COMMIT");
    in_transaction_ = false;
    committed_bytes_ = measured_bytes();
    pending_bytes_ = 0;
  }
}

void FileWriter::close() {
  commit();
  insert_.clear();
  database_.leave_log();
}

std::uint64_t FileWriter::measured_bytes() const {
  Statement pages = database_.prepare("PRAGMA page_count");
  pages.step();
  Statement size = database_.prepare("PRAGMA page_size");
  size.step();
  return static_cast<std::uint64_t>(pages.number(0)) * static_cast<std::uint64_t>(size.number(0));
}

}  // namespace adstar::bag
