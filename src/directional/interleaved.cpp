#include "directional/interleaved.h"

#include <algorithm>

#include "filters/bilateral_kernel.h"

namespace obscura::directional {
namespace {

constexpr int kRowsPerTask = 8;
constexpr int kBlock = 256;  // pixels between kernel and output
constexpr int kVector = 16;  // kernels may write so much past the end

template <class Body>  // body(y)
void for_rows(int height, Executor& executor, const Body& body) {
  executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
    const int end = std::min(height, (task + 1) * kRowsPerTask);
    for (int y = task * kRowsPerTask; y < end; ++y) body(y);
  });
}

}  // namespace

void InterleavedSums::resize(int width, int height, bool blur) {
  auto make = [&](AlignedImage<float>& image) {
    image.resize(width + 2 * kMargin + kVector, height);
    std::fill_n(image.data(), image.stride() * height, 0.0f);
  };
  for (auto& image : sums_) make(image);
  if (!blur) return;
  for (auto& image : rows_) make(image);
  for (auto& image : normals_) make(image);
  make(surface_);
}

// Whole vectors were written; what the blur meets beyond the row counts nothing, if finite.
void InterleavedSums::close_row(int channels, int width, int y) {
  for (int c = 0; c < channels; ++c) std::fill_n(row(c, y) + width, kMargin, 0.0f);
}

void InterleavedSums::resolve(const view::Geometry& g, const Resolve& how, const Outputs& o,
                              Executor& executor) {
  const int width = g.visible_width(), height = g.visible_height();
  // Taps up to half the tile away, the outermost with half the weight: each pixel of the tile
  // counts the same.
  const int m = how.interleave, reach = m / 2;
  BlurRow shared;
  shared.channels = how.directions ? kChannels : 1;
  shared.orthographic = g.camera.orthographic;
  shared.edge = how.edge;
  for (int k = 0; k <= reach; ++k) shared.weights[k] = m % 2 == 0 && k == reach ? 0.5f : 1.0f;
  if (m > 1) for_rows(height, executor, [&](int y) { blur_rows(g, shared, reach, y); });
  for_rows(height, executor, [&](int y) {
    alignas(64) float block[kChannels][kBlock];
    float* const blurred[kChannels] = {block[0], block[1], block[2], block[3]};
    for (int x = 0; x < width; x += kBlock) {
      const int count = std::min(kBlock, width - x);
      const float* sums[kChannels] = {row(0, y) + x, row(1, y) + x, row(2, y) + x, row(3, y) + x};
      if (m > 1) {
        blur_columns(shared, reach, height, y, x, count, blurred);
        std::copy_n(blurred, kChannels, sums);
      }
      write(g, how, o, y, x, count, sums);
    }
  });
}

void InterleavedSums::blur_rows(const view::Geometry& g, const BlurRow& shared, int reach, int y) {
  const int width = g.visible_width(), row_of = g.guard_band.top + y;
  float* surface = surface_.row(y) + kMargin;
  surface_row(g.depth.row(row_of) + g.guard_band.left, width, g.camera.orthographic, surface);
  std::fill_n(surface + width, kMargin, 0.0f);
  BlurRow row = shared;
  const AlignedImage<float>* normals[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  for (int k = 0; k < 3; ++k) {
    float* to = normals_[k].row(y) + kMargin;
    if (g.has_normals) {
      std::copy_n(normals[k]->row(row_of) + g.guard_band.left, width, to);
    } else {
      std::fill_n(to, width, k == 2 ? 1.0f : 0.0f);  // all alike
    }
    row.normal[k] = to;
  }
  for (int c = 0; c < shared.channels; ++c) {
    row.values[c] = this->row(c, y);
    row.out[c] = rows_[c].row(y) + kMargin;
  }
  row.surface = surface;
  row.first_tap = -reach;
  row.last_tap = reach;
  blur_row(row, width);
}

void InterleavedSums::blur_columns(const BlurRow& shared, int reach, int height, int y, int x,
                                   int count, float* const out[kChannels]) {
  BlurRow row = shared;
  for (int c = 0; c < shared.channels; ++c) {
    row.values[c] = rows_[c].row(y) + kMargin + x;
    row.out[c] = out[c];
  }
  for (int k = 0; k < 3; ++k) row.normal[k] = normals_[k].row(y) + kMargin + x;
  row.surface = surface_.row(y) + kMargin + x;
  row.value_step = rows_[0].stride();
  row.surface_step = surface_.stride();
  row.normal_step = normals_[0].stride();
  row.first_tap = -std::min(reach, y);
  row.last_tap = std::min(reach, height - 1 - y);
  blur_row(row, count);
}

void InterleavedSums::write(const view::Geometry& g, const Resolve& how, const Outputs& o, int y,
                            int x, int count, const float* const sums[kChannels]) {
  auto copy = [&](const ImageView<float>& to, const float* from) {
    if (to.empty()) return;
    if (to.pixel_stride == 1) {
      std::copy_n(from, count, &to(x, y));
      return;
    }
    for (int i = 0; i < count; ++i) to(x + i, y) = from[i];
  };
  if (how.sums == Sums::kRadiance) {
    copy(o.radiance.x, sums[0]), copy(o.radiance.y, sums[1]), copy(o.radiance.z, sums[2]);
    return;
  }
  alignas(64) float block[8][kBlock];
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
  Results r;
  r.visibility = o.visibility.empty() ? nullptr : block[0];
  r.angle = angle ? block[1] : nullptr;
  for (int k = 0; k < 3; ++k) {
    r.direction[k] = direction ? block[2 + k] : nullptr;
    r.integral[k] = how.directions && !integral.empty() ? block[5 + k] : nullptr;
  }
  const float* used[kChannels] = {sums[0]};
  if (how.directions) std::copy_n(sums, kChannels, used);
  finish_row({.cosine = cosine,
              .cosine_open = how.sums == Sums::kUniformDirections,
              .paper_cone = how.paper_cone},
             used, normal, count, r);
  copy(o.visibility, block[0]);
  if (angle) copy(o.cone_angle, block[1]);
  const VectorView<float>* vectors[] = {&o.bent_normal, &integral};
  for (int i = 0; i < 2; ++i) {
    if (i == 0 ? !direction : !r.integral[0]) continue;
    copy(vectors[i]->x, block[2 + 3 * i]);
    copy(vectors[i]->y, block[3 + 3 * i]);
    copy(vectors[i]->z, block[4 + 3 * i]);
  }
}

}  // namespace obscura::directional
