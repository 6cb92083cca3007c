#include "filters/interleaved/interleaved.h"

#include <algorithm>

#include "filters/bilateral/kernel.h"

namespace obscura::interleaved {
namespace {

// Pixels of a tile, whose intermediate rows stay in a second-level cache.
constexpr int kTileWidth = 256, kTileHeight = 32;
constexpr int kMargin = 16;  // left and right of each row; kernels write less past the end
constexpr int kReach = kMaxInterleave / 2;
constexpr int kStride = kTileWidth + 3 * kMargin, kRows = kTileHeight + 2 * kReach;

}  // namespace

// Of one tile with its surroundings: what the first direction of the blur reads beside the sums,
// and what it gives.
struct InterleavedSums::Tile {
  static float* row(float (*plane)[kStride], int y) { return plane[y] + kMargin; }

  alignas(64) float surface[kRows][kStride];
  alignas(64) float normal[3][kRows][kStride];
  alignas(64) float blurred[kChannels][kRows][kStride];
};

InterleavedSums::InterleavedSums() = default;
InterleavedSums::~InterleavedSums() = default;

void InterleavedSums::resize(int width, int height) {
  for (auto& image : sums_) {
    image.resize(width + 3 * kMargin, height);
    std::fill_n(image.data(), image.stride() * height, 0.0f);
  }
}

float* InterleavedSums::row(int channel, int y) { return sums_[channel].row(y) + kMargin; }

// Whole vectors were written; what the blur meets beyond the row counts nothing, if finite.
void InterleavedSums::close_row(int channels, int width, int y) {
  for (int c = 0; c < channels; ++c) std::fill_n(row(c, y) + width, kMargin, 0.0f);
}

void InterleavedSums::resolve(const view::Geometry& g, const Resolve& how, const Outputs& o,
                              Executor& executor) {
  const int width = g.visible().width, height = g.visible().height;
  const int across = (width + kTileWidth - 1) / kTileWidth;
  const int down = (height + kTileHeight - 1) / kTileHeight;
  if (how.interleave > 1) {
    while (static_cast<int>(tiles_.size()) < executor.thread_count()) {
      tiles_.push_back(std::make_unique<Tile>());
    }
  }
  executor.parallel_for(across * down, [&](int task, int worker) {
    const int x = task % across * kTileWidth, y = task / across * kTileHeight;
    const int columns = std::min(kTileWidth, width - x), end = std::min(height, y + kTileHeight);
    if (how.interleave > 1) {
      blur_tile(g, how, o, x, y, columns, end, tiles_[worker].get());
      return;
    }
    for (int at = y; at < end; ++at) {
      const float* sums[kChannels] = {};
      for (int c = 0; c < kChannels; ++c) sums[c] = row(c, at) + x;
      write(g, how, o, at, x, columns, sums);
    }
  });
}

void InterleavedSums::blur_tile(const view::Geometry& g, const Resolve& how, const Outputs& o,
                                int x, int first, int columns, int end, Tile* tile) {
  const int height = g.visible().height, m = how.interleave, reach = m / 2;
  // Taps up to half the tile of the pattern away, the outermost with half the weight: each of its
  // pixels counts the same.
  BlurRow shared;
  shared.channels = how.directions ? kChannels : 1;
  shared.orthographic = g.camera.orthographic;
  shared.edge = how.edge;
  shared.edges_per_depth = how.edges_per_depth;
  for (int k = 0; k <= reach; ++k) shared.weights[k] = m % 2 == 0 && k == reach ? 0.5f : 1.0f;

  const int above = std::max(0, first - reach), below = std::min(height, end + reach);
  for (int y = above; y < below; ++y) {
    load_row(g, x, columns, y, y - above, tile);
    BlurRow row = shared;
    row.surface = Tile::row(tile->surface, y - above);
    for (int k = 0; k < 3; ++k) row.normal[k] = Tile::row(tile->normal[k], y - above);
    for (int c = 0; c < shared.channels; ++c) {
      row.values[c] = this->row(c, y) + x;
      row.out[c] = Tile::row(tile->blurred[c], y - above);
    }
    row.first_tap = -reach;
    row.last_tap = reach;
    blur_row(row, columns);
  }
  alignas(64) float block[kChannels][kTileWidth];
  const float* const sums[kChannels] = {block[0], block[1], block[2], block[3]};
  for (int y = first; y < end; ++y) {
    BlurRow row = shared;
    row.surface = Tile::row(tile->surface, y - above);
    for (int k = 0; k < 3; ++k) row.normal[k] = Tile::row(tile->normal[k], y - above);
    for (int c = 0; c < shared.channels; ++c) {
      row.values[c] = Tile::row(tile->blurred[c], y - above);
      row.out[c] = block[c];
    }
    row.value_step = row.surface_step = row.normal_step = kStride;
    row.first_tap = -std::min(reach, y);
    row.last_tap = std::min(reach, height - 1 - y);
    blur_row(row, columns);
    write(g, how, o, y, x, columns, sums);
  }
}

// Surface and normals of one row from kReach left of column x on; background beyond the image.
void InterleavedSums::load_row(const view::Geometry& g, int x, int columns, int y, int to,
                               Tile* tile) {
  const int begin = std::max(0, x - kReach),
            end = std::min(g.visible().width, x + columns + kReach);
  const int row_of = g.guard_band.top + y, at = g.guard_band.left + begin, shift = begin - x;
  float* surface = Tile::row(tile->surface, to);
  surface_row(g.depth.row(row_of) + at, end - begin, g.camera.orthographic, surface + shift);
  std::fill(surface - kReach, surface + shift, 0.0f);
  std::fill_n(surface + (end - x), kMargin, 0.0f);
  const AlignedImage<float>* normals[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  for (int k = 0; k < 3; ++k) {
    float* normal = Tile::row(tile->normal[k], to) + shift;
    if (g.has_normals) {
      std::copy_n(normals[k]->row(row_of) + at, end - begin, normal);
    } else {
      std::fill_n(normal, end - begin, k == 2 ? 1.0f : 0.0f);  // all alike
    }
  }
}

void InterleavedSums::write(const view::Geometry& g, const Resolve& how, const Outputs& o, int y,
                            int x, int count, const float* const sums[kChannels]) {
  // Kernels write whole vectors: straight to where neighbours lie side by side and none is too
  // much.
  const bool whole = count % kMargin == 0;
  auto direct = [&](const ImageView<float>& to, float* block) {
    return whole && to.pixel_stride == 1 ? &to(x, y) : block;
  };
  auto copy = [&](const ImageView<float>& to, const float* from) {
    if (to.empty() || from == &to(x, y)) return;
    for (int i = 0; i < count; ++i) to(x + i, y) = from[i];
  };
  if (how.sums == Sums::kRadiance) {
    copy(o.radiance.x, sums[0]), copy(o.radiance.y, sums[1]), copy(o.radiance.z, sums[2]);
    return;
  }
  alignas(64) float block[8][kTileWidth];
  const bool cosine = how.sums == Sums::kCosine;
  const std::ptrdiff_t at = (g.guard_band.top + y) * g.depth.stride() + g.guard_band.left + x;
  const float* normal[3] = {};
  if (how.directions) {
    normal[0] = g.normal_x.data() + at;
    normal[1] = g.normal_y.data() + at;
    normal[2] = g.normal_z.data() + at;
  }
  const VectorView<float>& integral = cosine ? o.cosine_integral : o.uniform_integral;
  const bool direction = how.directions && !cosine && !o.bent_normal.empty();
  const bool angle = how.directions && !cosine && !o.cone_angle.empty();
  const bool integrated = how.directions && !integral.empty();
  Results r;
  const VectorView<float>& bent = o.bent_normal;
  r.visibility = o.visibility.empty() ? nullptr : direct(o.visibility, block[0]);
  r.angle = angle ? direct(o.cone_angle, block[1]) : nullptr;
  const ImageView<float>* axes[2][3] = {{&bent.x, &bent.y, &bent.z},
                                        {&integral.x, &integral.y, &integral.z}};
  for (int k = 0; k < 3; ++k) {
    r.direction[k] = direction ? direct(*axes[0][k], block[2 + k]) : nullptr;
    r.integral[k] = integrated ? direct(*axes[1][k], block[5 + k]) : nullptr;
  }
  const float* used[kChannels] = {sums[0]};
  if (how.directions) std::copy_n(sums, kChannels, used);
  finish_row({.cosine = cosine,
              .cosine_open = how.sums == Sums::kUniformDirections,
              .paper_cone = how.paper_cone},
             used, normal, count, r);
  copy(o.visibility, r.visibility);
  if (angle) copy(o.cone_angle, r.angle);
  for (int k = 0; k < 3; ++k) {
    if (direction) copy(*axes[0][k], r.direction[k]);
    if (integrated) copy(*axes[1][k], r.integral[k]);
  }
}

}  // namespace obscura::interleaved
