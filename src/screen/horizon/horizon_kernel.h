#ifndef OBSCURA_SRC_SCREEN_HORIZON_HORIZON_KERNEL_H_
#define OBSCURA_SRC_SCREEN_HORIZON_HORIZON_KERNEL_H_

#include "math/falloff.h"
#include "view/tap_frame.h"

namespace obscura::horizon {

inline constexpr int kMaxDirections = 64;
inline constexpr int kMaxInterleave = 8;
inline constexpr int kTileRow = kMaxInterleave + 16;  // a row repeats, for loads of whole vectors

// What differs from pixel to pixel of the tile.
enum TileValue {
  kTileCos,  // rotation of the directions
  kTileSin,
  kTileShift,  // share of a step to go on
  kTileValues
};

struct Frame {
  view::TapFrame view;
  const math::Rho* rho = nullptr;
  float reach = 0;  // world units; samples end there
  int directions = 0, steps = 0, interleave = 1;
  float cosine[kMaxDirections] = {}, sine[kMaxDirections] = {};
  float shift[kMaxDirections] = {};  // of the samples, in steps
  bool chord = false;                // slices: where matter is (SlabProfile)
  float tile[kTileValues][kMaxInterleave][kTileRow] = {};
  float bias_sine = 0, bias_cosine = 1;  // classic
};

// Write the visibility of the visible pixels [begin, end) of a visible row to out[0...].
void slices_row(const Frame& frame, int row, int begin, int end, float* out);
void classic_row(const Frame& frame, int row, int begin, int end, float* out);

}  // namespace obscura::horizon

#endif  // OBSCURA_SRC_SCREEN_HORIZON_HORIZON_KERNEL_H_
