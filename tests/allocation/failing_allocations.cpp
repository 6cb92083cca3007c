#include "tests/allocation/failing_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace obscura::allocation {
namespace {

std::atomic<long> left{-1};  // allocations until the one that fails; negative: none does

void count() {
  if (left.load(std::memory_order_relaxed) < 0) return;
  if (left.fetch_sub(1) == 0) throw std::bad_alloc();
}

void* checked(void* memory) {
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void fail_at(long n) { left = n; }
bool stop_failing() { return left.exchange(-1) < 0; }

}  // namespace obscura::allocation

void* operator new(std::size_t size) {
  obscura::allocation::count();
  return obscura::allocation::checked(std::malloc(size > 0 ? size : 1));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  obscura::allocation::count();
  const auto a = static_cast<std::size_t>(alignment);
  return obscura::allocation::checked(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return operator new(size, alignment);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
