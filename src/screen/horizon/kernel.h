#ifndef OBSCURA_SRC_SCREEN_HORIZON_KERNEL_H_
#define OBSCURA_SRC_SCREEN_HORIZON_KERNEL_H_

#include "filters/interleaved/kernel.h"
#include "math/falloff.h"
#include "math/slice_sums.h"
#include "view/matter.h"
#include "view/tap_frame.h"

namespace obscura::horizon {

inline constexpr int kMaxDirections = 64;
using interleaved::kMaxInterleave;

// The blur's edges are no longer than a twentieth of the pixel's depth.
inline constexpr float kEdgesPerDepth = 20;

// What differs from pixel to pixel of the tile.
enum TileValue {
  kTileCos,  // rotation of the directions
  kTileSin,
  kTileShift,  // share of a step to go on
  kTileValues
};

struct Frame {
  view::TapFrame view;
  view::Matter matter = view::Matter::kSolid;
  float thickness = 0;          // of kThickness, along the view ray
  const float* back = nullptr;  // of kWithBack, like view.depth
  const math::Rho* rho = nullptr;
  float reach = 0;  // world units; samples end there
  int directions = 0, steps = 0, interleave = 1;
  float cosine[kMaxDirections] = {}, sine[kMaxDirections] = {};
  float shift[kMaxDirections] = {};  // of the samples, in steps
  bool chord = false;                // slices: where matter is (SlabProfile)
  float tile[kTileValues][kMaxInterleave][kMaxInterleave] = {};
  float bias_sine = 0, bias_cosine = 1;  // classic
};

// Sums of one visible row as filters/interleaved/kernel.h has them. Slices: `open` is always
// cosine-weighted; kVisibility writes that channel alone. Classic: all is uniform, directions are
// written if out[1] is there.
using Rows = float* const[interleaved::kChannels];
void slices_row(const Frame& frame, SliceSums sums, int row, int width, Rows out);
void classic_row(const Frame& frame, int row, int width, Rows out);

}  // namespace obscura::horizon

#endif  // OBSCURA_SRC_SCREEN_HORIZON_KERNEL_H_
