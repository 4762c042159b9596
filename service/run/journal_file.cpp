#include "service/run/journal_file.hpp"

#include <array>
#include <fcntl.h>

#include <fmt/format.h>

namespace adstar::run {
namespace {

constexpr std::array<char, 8> kMagic{'a', 'd', 's', 't', 'a', 'r', 'j', 'o'};
constexpr std::uint64_t kFormat = 1;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t format = kFormat;
  std::uint64_t run = 0;
  std::uint64_t sum = 0;
};

std::uint64_t sum_of(std::uint64_t run) {
  const std::array<std::uint64_t, 2> parts{kFormat, run};
  return checksum(std::as_bytes(std::span(parts)));
}

struct Entry {
  runtime::JournalRecord record;
  std::uint64_t sum = 0;
};

std::uint64_t sum_of(const runtime::JournalRecord& record) {
  return checksum(std::as_bytes(std::span(&record, 1)));
}

}  // namespace

JournalFile::JournalFile(const std::filesystem::path& path, std::uint64_t run)
    : file_(path, O_WRONLY | O_CREAT | O_TRUNC) {
  run::append(bytes_, Header{kMagic, kFormat, run, sum_of(run)});
  file_.write(bytes_);
  length_ = bytes_.size();
  File(path.parent_path(), O_RDONLY | O_DIRECTORY).sync();
}

void JournalFile::append(std::span<const runtime::JournalRecord> records) {
  bytes_.clear();
  for (const runtime::JournalRecord& record : records) {
    run::append(bytes_, Entry{record, sum_of(record)});
  }
  if (torn_) {
    file_.truncate(length_);
  }
  torn_ = true;
  file_.write(bytes_);
  torn_ = false;
  length_ += bytes_.size();
}

JournalText journal_from(std::span<const std::byte> bytes) {
  JournalText text;
  const auto header = take<Header>(bytes);
  if (!header) {
    text.damage = "is no journal, or was cut off at its beginning";
    return text;
  }
  text.unreadable = true;
  if (header->magic != kMagic) {
    text.damage = "is no journal, or was changed at its beginning";
    return text;
  }
  if (header->format != kFormat || header->sum != sum_of(header->run)) {
    text.damage = "is of another version of adstar, or was changed at its beginning";
    return text;
  }
  text.unreadable = false;
  text.run = header->run;
  for (std::size_t place = 0; !bytes.empty(); ++place) {
    const auto entry = take<Entry>(bytes);
    std::string damage;
    if (!entry) {
      damage = fmt::format("is cut off in record {}", place);
      bytes = {};
    } else if (entry->sum != sum_of(entry->record)) {
      damage = fmt::format("was changed in record {}: its checksum does not match", place);
    } else {
      text.records.push_back(entry->record);
    }
    text.damage = text.damage.empty() ? damage : text.damage;
  }
  return text;
}

}  // namespace adstar::run
