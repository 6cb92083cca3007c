#include "screen/area/moments.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "screen/area/moments_kernel.h"

namespace obscura {
namespace {

constexpr int kMargin = 16;  // texels of share 0 beside a row; taps reach 8 far
constexpr int kRowsPerTask = 8;

int level_size(int size, int level) { return ((size - 1) >> MomentPyramid::shift(level)) + 1; }

int level_count(int width, int height) {
  // A kernel as wide as the image is the last that says anything.
  int levels = 1;
  while (levels < MomentPyramid::kMaxLevels && (4 << levels) < std::max(width, height)) ++levels;
  return levels;
}

int padded(int size, int levels) {
  const int step = 1 << MomentPyramid::shift(levels - 1);
  return (size + step - 1) / step * step;
}

}  // namespace

bool MomentPyramid::fits(int width, int height) {
  const int levels = level_count(width, height);
  return static_cast<std::int64_t>(padded(width, levels)) * padded(height, levels) <= 1 << 28;
}

void MomentPyramid::Planes::resize(int width, int height) {
  share.resize(width, height);
  mean.resize(width, height);
  variance.resize(width, height);
}

void MomentPyramid::resize(int width, int height) {
  width_ = width;
  height_ = height;
  levels_ = level_count(width, height);
  stride_ = padded(width, levels_);
  area_ = static_cast<std::int64_t>(stride_) * padded(height, levels_);
  texels_.resize(levels_ < kFullLevels ? levels_ * area_ : 4 * area_);
  now_.resize(width, height);
  next_.resize(width, height);
  background_.resize(width, 1);
  for (AlignedImage<float>* plane :
       {&background_.share, &background_.mean, &background_.variance}) {
    std::fill_n(plane->data(), plane->stride(), 0.0f);
  }
}

void MomentPyramid::build(const view::Geometry& geometry, Executor& executor) {
  while (static_cast<int>(scratch_.size()) < executor.thread_count()) {
    Scratch& s = scratch_.emplace_back();
    s.vertical.resize(width_ + 2 * kMargin, 1);
    s.wide.resize(width_, 1);
  }
  start_level(geometry, executor);
  pack(0, executor);
  for (int level = 1; level < levels_; ++level) {
    next_level(level, executor);
    std::swap(now_, next_);
    pack(level, executor);
  }
}

void MomentPyramid::start_level(const view::Geometry& geometry, Executor& executor) {
  executor.parallel_for(height_, [&](int y, int) {
    const float* depth = geometry.depth.row(y);
    for (int x = 0; x < width_; ++x) {
      const bool surface = depth[x] < std::numeric_limits<float>::infinity();
      now_.share(x, y) = surface ? 1.0f : 0.0f;
      now_.mean(x, y) = surface ? depth[x] : 0.0f;
      now_.variance(x, y) = 0;
    }
  });
}

void MomentPyramid::next_level(int level, Executor& executor) {
  const int width = level_size(width_, level - 1), height = level_size(height_, level - 1);
  const int step = level < kFullLevels ? 1 << (level - 1) : 4;  // between taps, in texels
  const int keep = shift(level) - shift(level - 1) + 1;         // every which texel
  const int new_width = level_size(width_, level), new_height = level_size(height_, level);
  executor.parallel_for((new_height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int worker) {
    Scratch& s = scratch_[worker];
    Planes& column = s.vertical;
    const int end = std::min(new_height, (task + 1) * kRowsPerTask);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      MomentRow rows[5];
      for (int k = 0; k < 5; ++k) {
        const int from = y * keep + (k - 2) * step;
        const bool inside = from >= 0 && from < height;
        const Planes& p = inside ? now_ : background_;
        const int row = inside ? from : 0;
        rows[k] = {p.share.row(row), p.mean.row(row), p.variance.row(row)};
      }
      merge_moments(rows, width, column.share.data() + kMargin, column.mean.data() + kMargin,
                    column.variance.data() + kMargin);
      for (AlignedImage<float>* plane : {&column.share, &column.mean, &column.variance}) {
        std::fill_n(plane->data(), kMargin, 0.0f);
        std::fill_n(plane->data() + kMargin + width, kMargin, 0.0f);
      }
      for (int k = 0; k < 5; ++k) {
        const int offset = kMargin + (k - 2) * step;
        rows[k] = {column.share.data() + offset, column.mean.data() + offset,
                   column.variance.data() + offset};
      }
      if (keep == 1) {
        merge_moments(rows, width, next_.share.row(y), next_.mean.row(y), next_.variance.row(y));
        continue;
      }
      merge_moments(rows, width, s.wide.share.data(), s.wide.mean.data(), s.wide.variance.data());
      for (int x = 0; x < new_width; ++x) {
        next_.share(x, y) = s.wide.share(x * keep, 0);
        next_.mean(x, y) = s.wide.mean(x * keep, 0);
        next_.variance(x, y) = s.wide.variance(x * keep, 0);
      }
    }
  });
}

void MomentPyramid::pack(int level, Executor& executor) {
  const int width = level_size(width_, level), height = level_size(height_, level);
  Texel* first = texels_.data() + start(level);
  const int stride = stride_ >> shift(level);
  executor.parallel_for(height, [&](int y, int) {
    Texel* out = first + static_cast<std::int64_t>(y) * stride;
    const float *share = now_.share.row(y), *mean = now_.mean.row(y);
    const float* variance = now_.variance.row(y);
    for (int x = 0; x < width; ++x) {
      const std::uint32_t deviation = std::bit_cast<std::uint32_t>(std::sqrt(variance[x]));
      const auto part = static_cast<std::uint32_t>(share[x] * 255 + 0.5f);
      out[x] = {mean[x], (deviation & ~255u) | part};
    }
  });
}

}  // namespace obscura
