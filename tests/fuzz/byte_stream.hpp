#pragma once
// The fuzzer's bytes, handed out as numbers; zeros when they have run out.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace adstar::fuzz {

class ByteStream {
 public:
  ByteStream(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }

  template <class Number>
  Number take() {
    static_assert(std::is_arithmetic_v<Number>);
    Number number{};
    const std::size_t size = left_ < sizeof number ? left_ : sizeof number;
    std::memcpy(&number, data_, size);
    data_ += size;
    left_ -= size;
    return number;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Ends the process as a sanitizer would, so that libFuzzer keeps the input.
[[noreturn]] inline void found(const char* what) {
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

}  // namespace adstar::fuzz
