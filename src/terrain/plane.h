#ifndef OBSCURA_SRC_TERRAIN_PLANE_H_
#define OBSCURA_SRC_TERRAIN_PLANE_H_

#include <algorithm>
#include <cstddef>

#include "core/large_array.h"
#include "obscura/executor.h"
#include "obscura/views.h"
#include "terrain/sweep_kernel.h"

namespace obscura {

// A grid with the margins that the sweeps need.
class TerrainPlane {
 public:
  // Contents are indeterminate afterwards. Allocates only when the plane grows. `margin`: rows
  // above and below, at least 1.
  void resize(int width, int height, int margin = 1) {
    width_ = width;
    height_ = height;
    margin_ = margin;
    pitch_ = (static_cast<std::ptrdiff_t>(width) + 2 * kTerrainMargin + 15) / 16 * 16;
    const std::size_t needed = static_cast<std::size_t>(pitch_) * (height + 2 * margin);
    if (values_.size() < needed) values_ = LargeArray<float>(needed);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int margin() const { return margin_; }
  std::ptrdiff_t pitch() const { return pitch_; }
  // Of row y in [-margin, height + margin), column 0; columns from -kTerrainMargin on.
  float* row(int y) { return values_.data() + (y + margin_) * pitch_ + kTerrainMargin; }
  const float* row(int y) const { return values_.data() + (y + margin_) * pitch_ + kTerrainMargin; }
  // The whole of it, margins included.
  void fill_row(int y, float value) { std::fill_n(row(y) - kTerrainMargin, pitch_, value); }

 private:
  int width_ = 0, height_ = 0, margin_ = 1;
  std::ptrdiff_t pitch_ = 0;
  LargeArray<float> values_;
};

inline constexpr int kTerrainTile = 64;

// What turns a tile between the two grids: rows of both are read and written in one piece.
class TileBuffer {
 public:
  float* row(int y) { return values_ + y * kPitch; }

 private:
  // Not a power of two: a column then lies in many sets of the cache.
  static constexpr int kPitch = kTerrainTile + 1;
  float values_[kTerrainTile * kPitch];
};

// Calls body(x0, y0, x1, y1) for tiles of an image, on threads. In a tile, an image and a
// transposed one are both read from the cache.
template <class Body>
void for_tiles(Extent size, Executor& executor, Body&& body) {
  constexpr int kTile = kTerrainTile;
  const int across = (size.width + kTile - 1) / kTile, down = (size.height + kTile - 1) / kTile;
  executor.parallel_for(down, [&](int row, int) {
    const int y0 = row * kTile, y1 = std::min(size.height, y0 + kTile);
    for (int i = 0; i < across; ++i) {
      const int x0 = i * kTile;
      body(x0, y0, std::min(size.width, x0 + kTile), y1);
    }
  });
}

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_PLANE_H_
