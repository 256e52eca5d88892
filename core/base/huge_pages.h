#pragma once

#include <cstddef>
#include <new>

namespace plenolab {

/// Memory of at least `bytes`, asked to lie in huge pages where the system has them (Linux: transparent huge
/// pages): arrays of many megabytes that are read all over then miss fewer address translations. Free it with
/// free_huge. Throws std::bad_alloc.
void* allocate_huge(std::size_t bytes);
void free_huge(void* memory) noexcept;

/// Allocator of standard containers that takes large arrays from allocate_huge.
template <class T>
struct HugePageAllocator {
  using value_type = T;
  static constexpr std::size_t kLarge = std::size_t{1} << 20;  ///< bytes; below, plain new

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    return static_cast<T*>(bytes < kLarge ? ::operator new(bytes, std::align_val_t(alignof(T)))
                                          : allocate_huge(bytes));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < kLarge)
      ::operator delete(memory, std::align_val_t(alignof(T)));
    else
      free_huge(memory);
  }
  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
};

}  // namespace plenolab
