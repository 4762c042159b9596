#pragma once
// The little of SQLite that a recording needs: one file, statements on it, and errors that name both.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace adstar::bag {

/// What a recording cannot do: which file, why, and what helps.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Statement {
 public:
  Statement(sqlite3* database, const std::filesystem::path& file, std::string_view sql);

  /// Parameters count from 1. Bytes and text must live until the next step() has returned.
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::span<const std::byte> bytes);

  /// True when there is a row. Throws Error.
  bool step();
  /// Runs it to its end, ready to be bound anew.
  void run();
  /// The same; false, and nothing is done, when another connection is in the way.
  bool try_run();

  /// Of the present row; columns count from 0.
  std::int64_t number(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> bytes(int column) const;

 private:
  void check(int code) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  sqlite3* database_;
  std::filesystem::path file_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Database {
 public:
  enum class Mode {
    make,  ///< refuses a file that is there already
    open,
    look,  ///< for reading, and without a trace: no log is merged, made or taken away, whosever it is
  };
  /// Throws Error.
  Database(const std::filesystem::path& file, Mode mode);

  void run(std::string_view sql);
  /// From a write-ahead log to one plain file. False when somebody else has it open: whoever closes it
  /// last merges the log.
  bool leave_log();
  /// Throws Error where the file was cut short within a page: SQLite takes what lacks for zeros, and rows for none.
  void require_whole_pages() const;
  Statement prepare(std::string_view sql) const { return {database_.get(), file_, sql}; }
  std::int64_t last_row() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  void read_log_without_index();

  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace adstar::bag
