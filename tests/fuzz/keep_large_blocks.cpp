// Every input makes a gate anew, with some megabytes that nothing but the first input should have to
// ask the system for: large blocks are kept from one input to the next (many times the inputs a second).
// Small ones are AddressSanitizer's as ever.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

constexpr std::size_t kLarge = 1U << 17U;
std::array<void*, 8> g_kept{};

void* allocate(std::size_t size, std::size_t alignment = alignof(std::max_align_t)) {
  if (size >= kLarge) {
    for (void*& block : g_kept) {
      if (block != nullptr && malloc_usable_size(block) >= size &&
          malloc_usable_size(block) < size + alignment &&
          reinterpret_cast<std::uintptr_t>(block) % alignment == 0) {
        void* const found = block;
        block = nullptr;
        return found;
      }
    }
  }
  void* const block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) {
    throw std::bad_alloc();
  }
  return block;
}

void release(void* block) noexcept {
  if (block != nullptr && malloc_usable_size(block) >= kLarge) {
    for (void*& place : g_kept) {
      if (place == nullptr) {
        place = block;
        return;
      }
    }
  }
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
  return allocate(size);  // running out of memory ends a fuzzer either way
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t /*size*/) noexcept { release(block); }
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept { release(block); }
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  release(block);
}
