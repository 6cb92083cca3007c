#ifndef OBSCURA_SRC_CORE_ALIGNED_IMAGE_H_
#define OBSCURA_SRC_CORE_ALIGNED_IMAGE_H_

#include <cstddef>
#include <memory>
#include <new>

#include "obscura/views.h"

namespace obscura {

// An owned image whose rows start on cache lines. Rows are padded to whole vectors, and a spare
// vector follows the last row, so that kernels may load and store whole vectors at any valid x.
template <class T>
class AlignedImage {
 public:
  static constexpr std::size_t kAlignment = 64;

  AlignedImage() = default;
  AlignedImage(int width, int height) { resize(width, height); }

  // Contents are indeterminate afterwards. Allocates only when the image grows.
  void resize(int width, int height) {
    width_ = width;
    height_ = height;
    constexpr std::ptrdiff_t step = kAlignment / sizeof(T);
    stride_ = (width + step - 1) / step * step;
    const std::size_t needed = static_cast<std::size_t>(stride_) * height + step;
    if (needed > capacity_) {
      data_.reset(
          static_cast<T*>(::operator new(needed * sizeof(T), std::align_val_t(kAlignment))));
      capacity_ = needed;
    }
  }
  void release() { *this = AlignedImage(); }

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T* row(int y) { return data_.get() + y * stride_; }
  const T* row(int y) const { return data_.get() + y * stride_; }
  T& operator()(int x, int y) { return row(y)[x]; }
  const T& operator()(int x, int y) const { return row(y)[x]; }
  ImageView<T> view() { return {data_.get(), width_, height_, stride_}; }
  ImageView<const T> view() const { return {data_.get(), width_, height_, stride_}; }

 private:
  struct Free {
    void operator()(T* p) const { ::operator delete(p, std::align_val_t(kAlignment)); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t capacity_ = 0;
  std::ptrdiff_t stride_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_ALIGNED_IMAGE_H_
