#ifndef OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_KERNEL_H_
#define OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_KERNEL_H_

#include <cstddef>

namespace obscura::hemisphere {

inline constexpr int kMaxSamples = 64;
inline constexpr int kMaxInterleave = 8;
inline constexpr int kTileRow = kMaxInterleave + 16;  // a row repeats, for loads of whole vectors
inline constexpr int kTaps = 5;  // of the blur on one side, the middle included

// What a pixel's samples have in sum: the channels that are blurred. Directions are differences to
// what the same share of all samples, occluded or not, would give, so that an open pixel's are zero
// exactly and its bent normal is the normal n (section 4):
//   uniform weights   open = mean V,                     x y z = mean V w - open mean w
//   cosine weights    open = sum V (n.w) / sum (n.w),    x y z the same with weights n.w
// The means of all w are n/2 and 2/3 n but for the pattern's own noise.
inline constexpr int kChannels = 4;

// What differs from pixel to pixel of the tile.
enum TileValue {
  kTileCos,  // rotation of the pattern
  kTileSin,
  kTileShift,                            // share of a stratum to go down
  kTileOffset,                           // share of a step to go on
  kTileMean,                             // 3: mean w in the receiver's frame
  kTileCosineMean = kTileMean + 3,       // 3: mean w, weights n.w
  kTileCosineSum = kTileCosineMean + 3,  // sum of n.w
  kTileValues
};

struct Frame {
  const float* depth = nullptr;
  const float* normal[3] = {};
  std::ptrdiff_t stride = 0;  // of depth and normals
  int width = 0, height = 0, left = 0, top = 0;
  bool orthographic = false;
  float scale_x = 0, scale_y = 0, center_u = 0, center_v = 0;

  float radius = 0;
  bool quadratic = false;
  float thickness = 0;  // 0: solid
  int samples = 0, tests = 0;
  int interleave = 1;
  float cosine[kMaxSamples] = {}, sine[kMaxSamples] = {};  // azimuths
  float offset[kMaxSamples] = {};                          // of the tests, in steps
  // Light by direction in eye space, at the vertices of a cube's faces: faces along x, -x, y, -y,
  // z, -z, whose rows run along the next axis and columns along the one after; R, G, B apart.
  const float* light[3] = {};
  int light_cells = 0;
  float tile[kTileValues][kMaxInterleave][kTileRow] = {};
};

// Sums of one visible row, of one kind at a time. `uniform` and `cosine` are kChannels rows each; a
// null x channel leaves out directions. Whole vectors are written past the end.
struct Sums {
  float* uniform[kChannels] = {};
  float* cosine[kChannels] = {};
  float* radiance[3] = {};  // sum V L (n.w) / sum (n.w); alone
};
void sum_row(const Frame& frame, int row, int width, const Sums& sums);

// One row of the blur in one direction, of `channels` images at once: tap k of pixel x is at
// x + k * step.
struct BlurRow {
  const float* values[kChannels] = {};
  float* out[kChannels] = {};
  int channels = 0;
  const float* surface = nullptr;  // linear on planes (bilateral_kernel.h); 0 or +inf: background
  const float* normal[3] = {};
  std::ptrdiff_t value_step = 1, surface_step = 1, normal_step = 1;
  int first_tap = 0, last_tap = 0;
  float weights[kTaps] = {};
  bool orthographic = false;
  float edge = 0;
};
void blur_row(const BlurRow& row, int width);

// From sums to results; all rows are of kernel length, null where not wanted.
struct Results {
  float* visibility = nullptr;  // of the sums given
  float* direction[3] = {};
  float* angle = nullptr;
  float* integral[3] = {};
};
void finish_uniform_row(const float* const sums[kChannels], const float* const normal[3],
                        bool paper_cone, int width, const Results& results);
void finish_cosine_row(const float* const sums[kChannels], const float* const normal[3], int width,
                       const Results& results);

}  // namespace obscura::hemisphere

#endif  // OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_KERNEL_H_
