#ifndef OBSCURA_VIEWS_H_
#define OBSCURA_VIEWS_H_

#include <cstddef>

namespace obscura {

// Pixels of an image along its sides.
struct Extent {
  int width = 0, height = 0;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool operator==(const Extent&) const = default;
};

// A caller-owned image: row 0 is the top row. Strides count elements of T, so that one view serves
// planar images (pixel_stride 1), a channel of an interleaved one (pixel_stride 3 or 4) and
// sub-rectangles. Negative strides are allowed.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t pixel_stride = 1;

  ImageView() = default;
  ImageView(T* pixels, int w, int h) : ImageView(pixels, w, h, w) {}
  ImageView(T* pixels, int w, int h, std::ptrdiff_t row, std::ptrdiff_t pixel = 1)
      : data(pixels), width(w), height(h), row_stride(row), pixel_stride(pixel) {}
  template <class U>
  requires(sizeof(U) == sizeof(T))
      ImageView(const ImageView<U>& o)  // from a mutable view to a const one
      : ImageView(o.data, o.width, o.height, o.row_stride, o.pixel_stride) {}

  bool empty() const { return data == nullptr; }
  T& operator()(int x, int y) const { return data[y * row_stride + x * pixel_stride]; }
};

// Three channels of one image, as three views of equal size.
template <class T>
struct VectorView {
  ImageView<T> x, y, z;

  VectorView() = default;
  VectorView(ImageView<T> vx, ImageView<T> vy, ImageView<T> vz) : x(vx), y(vy), z(vz) {}
  template <class U>
  requires(sizeof(U) == sizeof(T)) VectorView(const VectorView<U>& o) : x(o.x), y(o.y), z(o.z) {}

  // The usual interleaved image of three floats per pixel.
  static VectorView interleaved(T* pixels, int width, int height) {
    auto channel = [&](int c) { return ImageView<T>(pixels + c, width, height, 3 * width, 3); };
    return {channel(0), channel(1), channel(2)};
  }

  bool empty() const { return x.empty() && y.empty() && z.empty(); }
};

}  // namespace obscura

#endif  // OBSCURA_VIEWS_H_
