#ifndef OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_IO_H_
#define OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_IO_H_

#include "gpu/visibility_target.h"

IO_BEGIN(interleaved_io)
IO_NUMBER(kTile, 16);  // pixels a side that a group resolves
IO_THREADS(16, 8);
IO_TILE(kTile, kTile);
OBSCURA_VISIBILITY_TARGET;
IO_CONSTANT(2, int, kReach, 2);              // 0: no blur
IO_CONSTANT(3, bool, kHalfOutermost, true);  // the outermost taps' weights
IO_CONSTANT(4, int, kChannels, 1);           // values that are blurred
IO_CONSTANT(5, bool, kOpen, true);           // open_sums holds the visibility
IO_CONSTANT(6, bool, kDirections, false);
// The open share that goes with directions is the cosine-weighted visibility.
IO_CONSTANT(7, bool, kCosineOpen, false);
IO_CONSTANT(8, bool, kPaperCone, false);
IO_CONSTANT(9, bool, kUnsigned, false);
IO_CONSTANT(10, bool, kNormals, true);  // else all are alike
IO_READS(2, Depth, float, depth);
IO_READS(3, Normals, vec4, normals);
IO_READS(4, Open, float, open_sums);
IO_READS(5, Directions, vec4, sums);
IO_DIRECTIONS(6);
IO_PUSH(float edges_per_depth;);
IO_END

#endif  // OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_IO_H_
