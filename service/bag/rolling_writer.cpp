#include "service/bag/rolling_writer.hpp"

#include <fmt/format.h>

namespace adstar::bag {
namespace {

namespace fs = std::filesystem;

/// And those above it.
void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory.parent_path(), error);
  const bool made = !error && fs::create_directory(directory, error);
  if (error) {
    throw Error(fmt::format("cannot make '{}': {}; choose a directory that you may write to",
                            directory.string(), error.message()));
  }
  if (!made) {
    throw Error(fmt::format("'{}' is there already; choose another name", directory.string()));
  }
}

}  // namespace

RollingWriter::RollingWriter(const fs::path& directory, std::vector<TopicInfo> topics,
                             Rolling rolling)
    : directory_(fs::absolute(directory).lexically_normal()),
      topics_(std::move(topics)),
      rolling_(rolling) {
  if (directory_.filename().empty()) {
    directory_ = directory_.parent_path();  // "name/"
  }
  make_directory(directory_);
  lock_.emplace(directory_, DirectoryLock::Kind::recorder);
  for (const TopicInfo& topic : topics_) {
    metadata_.topics.push_back({topic, 0});
  }
  begin_file();
}

void RollingWriter::begin_file() {
  const std::string name =
      fmt::format("{}_{}.db3", directory_.filename().string(), metadata_.files.size());
  file_ = std::make_unique<FileWriter>(directory_ / name, topics_);
}

bool RollingWriter::is_over(std::int64_t received_ns) {
  if (file_->info().messages == 0) {
    return false;
  }
  if (rolling_.max_duration_ns &&
      received_ns - file_->info().first_ns >= *rolling_.max_duration_ns) {
    return true;
  }
  if (!rolling_.max_bytes || file_->size_bytes() < *rolling_.max_bytes) {
    return false;
  }
  file_->commit();  // now the size is exact
  return file_->size_bytes() >= *rolling_.max_bytes;
}

void RollingWriter::add(std::size_t topic, std::int64_t received_ns,
                        std::span<const std::byte> payload) {
  if (is_over(received_ns)) {
    file_->close();
    metadata_.files.push_back(file_->info());
    begin_file();
  }
  file_->add(topic, received_ns, payload);
  ++metadata_.topics[topic].messages;
}

void RollingWriter::commit() { file_->commit(); }

const Metadata& RollingWriter::finish() {
  file_->close();
  metadata_.files.push_back(file_->info());
  file_.reset();
  write_metadata(metadata_, directory_);
  lock_.reset();
  return metadata_;
}

}  // namespace adstar::bag
