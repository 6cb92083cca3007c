#include "screen/volumetric/area/moments.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "screen/volumetric/area/moments_kernel.h"

namespace obscura {
namespace {

constexpr int kMargin = 16;  // texels of share 0 beside a row; taps reach 8 far
constexpr int kRowsPerTask = 8;

}  // namespace

int MomentPyramid::level_count(int width, int height) {
  // A kernel as wide as the image is the last that says anything.
  int levels = 1;
  while (levels < kMaxLevels && (4 << levels) < std::max(width, height)) ++levels;
  return levels;
}

bool MomentPyramid::fits(int width, int height) { return std::int64_t{width} * height <= 1 << 28; }

void MomentPyramid::Planes::resize(int width, int height) {
  share.resize(width, height);
  mean.resize(width, height);
  variance.resize(width, height);
}

void MomentPyramid::resize(int width, int height) {
  width_ = width;
  height_ = height;
  levels_ = level_count(width, height);
  std::int64_t all = 0;
  for (int level = 0; level < levels_; ++level) {
    starts_[static_cast<std::size_t>(level)] = all;
    all += std::int64_t{row_stride(width, level)} * (level_size(height, level) + 1);
  }
  texels_.resize(static_cast<std::size_t>(all));
  now_.resize(width, height);
  next_.resize(width, height);
  columns_.clear();
  background_.resize(width, 1);
  for (AlignedImage<float>* plane :
       {&background_.share, &background_.mean, &background_.variance}) {
    std::fill_n(plane->data(), plane->stride(), 0.0f);
  }
}

void MomentPyramid::build(const view::Geometry& geometry, float slack, Executor& executor) {
  slack_ = slack;
  while (static_cast<int>(columns_.size()) < executor.thread_count()) {
    columns_.emplace_back().resize(width_ + 2 * kMargin, 1);
  }
  start_level(geometry, executor);
  for (int level = 0; level < levels_; ++level) {
    if (level > 0) advance_to(level, executor);
    pack_level(level, executor);
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

void MomentPyramid::advance_to(int level, Executor& executor) {
  if (shift(level) == shift(level - 1)) return std::swap(now_, next_);
  const int width = level_size(width_, level), height = level_size(height_, level);
  executor.parallel_for(height, [&](int y, int) {
    auto halve = [&](const AlignedImage<float>& from, AlignedImage<float>& to) {
      const float* in = from.row(2 * y);
      float* out = to.row(y);
      for (int x = 0; x < width; ++x) out[x] = in[2 * x];
    };
    halve(next_.share, now_.share);
    halve(next_.mean, now_.mean);
    halve(next_.variance, now_.variance);
  });
}

void MomentPyramid::pack_level(int level, Executor& executor) {
  const int width = level_size(width_, level), height = level_size(height_, level);
  const int step = 1 << (level - shift(level));  // between taps, in texels
  const bool last = level + 1 == levels_;
  executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int worker) {
    Planes& column = columns_[worker];
    const int end = std::min(height, (task + 1) * kRowsPerTask);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      const MomentRow now = now_.row(y);
      Texel* out =
          texels_.data() + start(level) + static_cast<std::int64_t>(y) * row_stride(width_, level);
      if (last) {
        pack_moments(now, now, width, slack_, out);
        continue;
      }
      MomentRow rows[5];
      for (int k = 0; k < 5; ++k) {
        const int from = y + (k - 2) * step;
        rows[k] = from >= 0 && from < height ? now_.row(from) : background_.row(0);
      }
      merge_moments(rows, width, slack_, column.share.data() + kMargin,
                    column.mean.data() + kMargin, column.variance.data() + kMargin);
      for (AlignedImage<float>* plane : {&column.share, &column.mean, &column.variance}) {
        std::fill_n(plane->data(), kMargin, 0.0f);
        std::fill_n(plane->data() + kMargin + width, kMargin, 0.0f);
      }
      for (int k = 0; k < 5; ++k) {
        const int offset = kMargin + (k - 2) * step;
        rows[k] = {column.share.data() + offset, column.mean.data() + offset,
                   column.variance.data() + offset};
      }
      merge_moments(rows, width, slack_, next_.share.row(y), next_.mean.row(y),
                    next_.variance.row(y));
      pack_moments(now, next_.row(y), width, slack_, out);
    }
  });
}

}  // namespace obscura
