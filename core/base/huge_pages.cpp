#include "core/base/huge_pages.h"

#include <sys/mman.h>

#include <cstdlib>

namespace plenolab {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

}  // namespace

void* allocate_huge(std::size_t bytes) {
  const std::size_t rounded = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  if (rounded < bytes) throw std::bad_alloc();
  void* memory = std::aligned_alloc(kHugePage, rounded);
  if (memory == nullptr) throw std::bad_alloc();
  ::madvise(memory, rounded, MADV_HUGEPAGE);  // advice: without huge pages it works the same, only slower
  return memory;
}

void free_huge(void* memory) noexcept {
  std::free(memory);
}

}  // namespace plenolab
