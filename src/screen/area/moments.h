#ifndef OBSCURA_SRC_SCREEN_AREA_MOMENTS_H_
#define OBSCURA_SRC_SCREEN_AREA_MOMENTS_H_

#include <cstdint>
#include <vector>

#include "core/aligned_image.h"
#include "obscura/executor.h"
#include "view/geometry.h"

namespace obscura {

// The depth image at growing footprints: for each texel of each level the mean and the standard
// deviation of the depths under a smooth kernel around it, and which share of the kernel sees a
// surface at all.
//
// Level l's kernel has a deviation of sqrt((4^l - 1) / 3) pixels in x and in y: level 0 is the
// image itself, each next level is the one before under the binomial (1 4 6 4 1)/16 with its taps
// spread to 2^(l-1) pixels. Levels from 3 on keep every 2^(l-2)-th texel only, still four to the
// kernel's width, so that the nearest texel stands for an interpolated one: a processor has no
// texture unit, and the paper's trilinear look-up would cost eight loads.
//
// Depths are averaged as means and deviations, by the law of total variance, which gives what
// E[z^2] - E[z]^2 would in exact arithmetic but does not cancel. Only surfaces are averaged:
// background has weight 0, and what it covers is kept as a share, so that it never bleeds into the
// moments.
class MomentPyramid {
 public:
  static constexpr int kMaxLevels = 11;
  static constexpr int kFullLevels = 3;  // that keep every texel

  struct Texel {
    float mean = 0;
    // A float's bits: the deviation, its lowest 8 bits replaced by the share of surface times 255.
    std::uint32_t deviation_and_share = 0;
  };

  // For depth images of this size. Whether `resize` would take it: at most 2^28 padded pixels.
  static bool fits(int width, int height);
  void resize(int width, int height);

  void build(const view::Geometry& geometry, Executor& executor);

  int levels() const { return levels_; }
  // Padded width of level 0 as a power of two's multiple; level l has stride() >> max(0, l - 2).
  int stride() const { return stride_; }
  // Texels of a full level. Level l starts at l * area() for l < 3, at 4 area() - (area() >> (l-3))
  // from there on.
  std::int64_t area() const { return area_; }
  const Texel* texels() const { return texels_.data(); }

  static int shift(int level) { return level < kFullLevels ? 0 : level - kFullLevels + 1; }
  std::int64_t start(int level) const {
    return level < kFullLevels ? level * area_ : 4 * area_ - (area_ >> (level - kFullLevels));
  }

 private:
  // A level's planes while the next one is made.
  struct Planes {
    AlignedImage<float> share, mean, variance;
    void resize(int width, int height);
  };
  // One worker's row between the vertical and the horizontal pass, and before every other texel is
  // dropped.
  struct Scratch {
    Planes vertical, wide;
  };
  void start_level(const view::Geometry& geometry, Executor& executor);
  void next_level(int level, Executor& executor);
  void pack(int level, Executor& executor);

  int width_ = 0, height_ = 0, levels_ = 0, stride_ = 0;
  std::int64_t area_ = 0;
  std::vector<Texel> texels_;
  Planes now_, next_;
  Planes background_;  // one row of share 0
  std::vector<Scratch> scratch_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_AREA_MOMENTS_H_
