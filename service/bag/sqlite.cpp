#include "service/bag/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

namespace adstar::bag {
namespace {

constexpr int kPatience_ms = 2000;

const char* remedy_of(int code) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "make room on the disk";
    case SQLITE_CANTOPEN:
      return "choose a directory that you may write to";
    case SQLITE_READONLY:
      return "copy the recording to where you may write: its log has to be merged";
    case SQLITE_CORRUPT:  // .recover is not in Debian's sqlite3
      return "move FILE away: the other files are read without it, or with what `sqlite3 FILE "
             ".dump | sed 's/^ROLLBACK.*/COMMIT;/' | sqlite3 NEW` saves of it, put in its place";
    case SQLITE_NOTADB:
      return "is it a recording? bring it back if there is a copy, or move it away: the other "
             "files are read without it";
    default:
      return "see the disk, and who else has the file open";
  }
}

[[noreturn]] void fail(sqlite3* database, int code, const std::filesystem::path& file) {
  throw Error(fmt::format("'{}': {}; {}", file.string(),
                          database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code),
                          remedy_of(code)));
}

/// The URI of a file that nobody writes to while it is open (sqlite.org/uri.html).
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file://";
  for (const char c : std::filesystem::absolute(file).string()) {
    uri += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02x}", c) : std::string(1, c);
  }
  return uri + "?immutable=1";
}

bool has_log(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file.string() + "-wal", none);
  return !none && size > 0;
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

void Database::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

Statement::Statement(sqlite3* database, const std::filesystem::path& file, std::string_view sql)
    : database_(database), file_(file) {
  sqlite3_stmt* made = nullptr;
  check(sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &made, nullptr));
  statement_.reset(made);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) {
    fail(database_, code, file_);
  }
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), parameter, value));
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view text) {
  check(sqlite3_bind_text(statement_.get(), parameter, text.data(), static_cast<int>(text.size()),
                          SQLITE_STATIC));
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::byte> bytes) {
  check(
      sqlite3_bind_blob64(statement_.get(), parameter, bytes.data(), bytes.size(), SQLITE_STATIC));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    fail(database_, code, file_);
  }
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {}
  check(sqlite3_reset(statement_.get()));
}

bool Statement::try_run() {
  int code = SQLITE_ROW;
  while (code == SQLITE_ROW) {
    code = sqlite3_step(statement_.get());
  }
  if ((code & 0xff) == SQLITE_BUSY) {
    sqlite3_reset(statement_.get());  // says the same once more
    return false;
  }
  if (code != SQLITE_DONE) {
    fail(database_, code, file_);
  }
  check(sqlite3_reset(statement_.get()));
  return true;
}

std::int64_t Statement::number(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* const text = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text), size);
}

std::span<const std::byte> Statement::bytes(int column) const {
  const auto* const blob = sqlite3_column_blob(statement_.get(), column);
  return {static_cast<const std::byte*>(blob),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  if (mode == Mode::make && std::filesystem::exists(file)) {
    throw Error(fmt::format("'{}' is there already; choose another name", file.string()));
  }
  sqlite3* made = nullptr;
  // Without a log all is in the file: it need not be locked, nor get an empty log while it is open.
  const bool is_immutable = mode == Mode::look && !has_log(file);
  // A file that nobody may write to is opened for reading alone.
  const int code =
      is_immutable
          ? sqlite3_open_v2(immutable_uri(file).c_str(), &made,
                            SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr)
          : sqlite3_open_v2(file.c_str(), &made,
                            SQLITE_OPEN_READWRITE | (mode == Mode::make ? SQLITE_OPEN_CREATE : 0),
                            nullptr);
  database_.reset(made);
  if (code != SQLITE_OK) {
    fail(made, code, file);
  }
  if (mode == Mode::look && !is_immutable) {
    read_log_without_index();
  }
  sqlite3_busy_timeout(made, kPatience_ms);
}

/// The log's index is a file beside it, but for who has the database alone. Where others have it open they have made that
/// file, and it is theirs to take away.
void Database::read_log_without_index() {
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  if (sqlite3_db_readonly(database_.get(), "main") == 0) {
    run("PRAGMA locking_mode=EXCLUSIVE");
    const int code = sqlite3_exec(database_.get(), "SELECT COUNT(*) FROM sqlite_master", nullptr,
                                  nullptr, nullptr);
    if ((code & 0xff) == SQLITE_BUSY) {
      run("PRAGMA locking_mode=NORMAL");
    }
  }
}

void Database::require_whole_pages() const {
  Statement page = prepare("PRAGMA page_size");
  page.step();
  std::error_code none;
  const auto size = std::filesystem::file_size(file_, none);
  if (!none && !has_log(file_) && size % static_cast<std::uint64_t>(page.number(0)) != 0) {
    fail(nullptr, SQLITE_CORRUPT, file_);
  }
}

void Database::run(std::string_view sql) { prepare(sql).run(); }

bool Database::leave_log() {
  sqlite3_busy_timeout(database_.get(), 0);
  const bool left = prepare("PRAGMA journal_mode=DELETE").try_run();
  sqlite3_busy_timeout(database_.get(), kPatience_ms);
  return left;
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(database_.get()); }

}  // namespace adstar::bag
