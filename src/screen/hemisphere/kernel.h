#ifndef OBSCURA_SRC_SCREEN_HEMISPHERE_KERNEL_H_
#define OBSCURA_SRC_SCREEN_HEMISPHERE_KERNEL_H_

#include <cstddef>

#include "filters/interleaved/kernel.h"
#include "view/matter.h"

namespace obscura::hemisphere {

inline constexpr int kMaxSamples = 64;
using interleaved::kMaxInterleave;
inline constexpr int kTileRow = kMaxInterleave + 16;  // a row repeats, for loads of whole vectors

#include "screen/hemisphere/tile_leaf.h"

struct Frame {
  const float* depth = nullptr;
  const float* normal[3] = {};
  std::ptrdiff_t stride = 0;  // of depth and normals
  int width = 0, height = 0, left = 0, top = 0;
  bool orthographic = false;
  float scale_x = 0, scale_y = 0, center_u = 0, center_v = 0;

  float radius = 0;
  bool quadratic = false;
  view::Matter matter = view::Matter::kSolid;
  float thickness = 0;          // of kThickness
  const float* back = nullptr;  // of kWithBack, like depth
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

// Sums of one visible row, of one kind at a time, as filters/interleaved/kernel.h has them but
// with the means of the pattern's own directions in place of n/2 and 2/3 n, from which they differ
// by the pattern's noise. A null x channel leaves out directions. Whole vectors are written past
// the end.
struct Sums {
  float* uniform[interleaved::kChannels] = {};
  float* cosine[interleaved::kChannels] = {};
  float* radiance[3] = {};  // sum V L (n.w) / sum (n.w); alone
};
void sum_row(const Frame& frame, int row, int width, const Sums& sums);

}  // namespace obscura::hemisphere

#endif  // OBSCURA_SRC_SCREEN_HEMISPHERE_KERNEL_H_
