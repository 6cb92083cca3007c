#include "core/large_array.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace obscura {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21;

}  // namespace

void* allocate_large(std::size_t bytes) {
  void* memory = ::operator new(bytes, std::align_val_t(kLargePage));
#ifdef __linux__
  // A wish, which the system may not grant.
  if (bytes >= kLargePage) madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory) { ::operator delete(memory, std::align_val_t(kLargePage)); }

}  // namespace obscura
