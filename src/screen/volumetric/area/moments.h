#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_H_

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/aligned_image.h"
#include "obscura/executor.h"
#include "screen/volumetric/area/moments_kernel.h"
#include "view/geometry.h"

namespace obscura {

// The depth image at growing footprints: for each texel of each level the mean and the standard
// deviation of the depths under a smooth kernel around it, and which share of the kernel sees a
// surface at all.
//
// Level l's kernel has a deviation of sqrt((4^l - 1) / 3) pixels in x and in y: level 0 is the
// image itself, each next level is the one before under the binomial (1 4 6 4 1)/16 with its taps
// spread to 2^(l-1) pixels. Levels from 2 on keep every 2^(l-1)-th texel only, still two to the
// kernel's width, so that the nearest texel stands for an interpolated one: a processor has no
// texture unit, and the paper's trilinear look-up would cost eight loads. Each texel holds the next
// level's moments at its place as well, so that interpolation between levels needs one load of 16
// bytes.
//
// Depths are averaged as means and deviations, by the law of total variance, which gives what
// E[z^2] - E[z]^2 would in exact arithmetic but does not cancel. Only surfaces are averaged:
// background has weight 0, and what it covers is kept as a share, so that it never bleeds into the
// moments. Surfaces far behind others count as background beside them (math/apart_leaf.h). Where
// level l sees background only, the next level's mean and deviation stand in, so that they can be
// interpolated; the share says that they do not count.
class MomentPyramid {
 public:
  static constexpr int kMaxLevels = 11;
  static constexpr int kFullLevels = 2;  // that keep every texel

  using Texel = MomentTexel;

  static int level_count(int width, int height);
  // Texels that a level has of `size` pixels.
  static int level_size(int size, int level) { return ((size - 1) >> shift(level)) + 1; }

  // For depth images of this size. Whether `resize` would take it: at most 2^28 pixels.
  static bool fits(int width, int height);
  void resize(int width, int height);

  // Depths that differ by up to four times `slack` never lie apart.
  void build(const view::Geometry& geometry, float slack, Executor& executor);

  int width() const { return width_; }
  int levels() const { return levels_; }
  // From one row of a level to the next. A spare texel ends each row, a spare row each level.
  static int row_stride(int width, int level) { return level_size(width, level) + 1; }
  const Texel* texels() const { return texels_.data(); }

  // The deviation of level l's kernel, in pixels.
  static double kernel_width(int level) { return std::sqrt((std::exp2(2 * level) - 1) / 3); }
  // Level l keeps every 2^shift-th texel.
  static int shift(int level) { return level < kFullLevels ? 0 : level - kFullLevels + 1; }
  // Where level l starts.
  std::int64_t start(int level) const { return starts_[static_cast<std::size_t>(level)]; }

 private:
  struct Planes {
    AlignedImage<float> share, mean, variance;
    void resize(int width, int height);
    MomentRow row(int y) const { return {share.row(y), mean.row(y), variance.row(y)}; }
  };
  void start_level(const view::Geometry& geometry, Executor& executor);
  // Makes level + 1 of all texels of `level` and packs both.
  void pack_level(int level, Executor& executor);
  // Goes on from level - 1, whose texels next_ has, to `level`.
  void advance_to(int level, Executor& executor);

  int width_ = 0, height_ = 0, levels_ = 0;
  std::array<std::int64_t, kMaxLevels> starts_{};
  float slack_ = 0;
  std::vector<Texel> texels_;
  Planes now_, next_;            // a level, and the next one at the same texels
  Planes background_;            // one row of share 0
  std::vector<Planes> columns_;  // per worker a row between the vertical and the horizontal pass
};

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_H_
