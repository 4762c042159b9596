#pragma once
// Buffered output to stdout or to a file that appears whole or not at all.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace adstar::cli {

class Output {
 public:
  static Output to_stdout();
  /// Written beside `file` and renamed by commit(); what is no regular file is written in place.
  /// Throws Failure when it cannot.
  static Output to_file(const std::filesystem::path& file);

  Output(Output&& other) noexcept;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  Output& operator=(Output&&) = delete;
  /// What was not committed is dropped.
  ~Output();

  /// The text that waits; append to it, then call flush_if_full().
  std::string& buffer() noexcept { return buffer_; }
  void flush_if_full() {
    if (buffer_.size() >= kFull) {
      flush();
    }
  }
  /// Throws ReaderGone or Failure; that, too, when a stop is requested and the reader has taken nothing for a second.
  void flush();
  /// Flushes, and gives a file its name.
  void commit();

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 16U;

  Output(int fd, std::filesystem::path name, std::filesystem::path temporary)
      : fd_(fd), name_(std::move(name)), temporary_(std::move(temporary)) {}
  void wait_for_room() const;
  std::string printed_name() const;
  [[noreturn]] void fail(int error, std::string_view doing) const;

  int fd_;
  std::filesystem::path name_;       ///< empty: stdout
  std::filesystem::path temporary_;  ///< empty: written in place
  std::string buffer_;
};

}  // namespace adstar::cli
