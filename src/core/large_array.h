#ifndef OBSCURA_SRC_CORE_LARGE_ARRAY_H_
#define OBSCURA_SRC_CORE_LARGE_ARRAY_H_

#include <cstddef>
#include <memory>

namespace obscura {

// Memory for arrays of many megabytes that are read along columns: on large pages where the system
// has them, as each step to another row would else be a miss of the page tables. Throws
// std::bad_alloc.
void* allocate_large(std::size_t bytes);
void free_large(void* memory);

// An array of plain numbers in such memory. Contents are indeterminate.
template <class T>
class LargeArray {
 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size)
      : data_(static_cast<T*>(allocate_large(size * sizeof(T)))), size_(size) {}

  std::size_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(T* memory) const { free_large(memory); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_LARGE_ARRAY_H_
