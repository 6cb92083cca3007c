#ifndef OBSCURA_SRC_SCREEN_HORIZON_HORIZON_IO_H_
#define OBSCURA_SRC_SCREEN_HORIZON_HORIZON_IO_H_

#include "gpu/io.h"
#include "gpu/rho_words.h"
#include "view/matter_io.h"

IO_BEGIN(horizon_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kDirections, 8);
IO_CONSTANT(1, int, kSteps, 8);
IO_CONSTANT(2, int, kInterleave, 4);
IO_CONSTANT(3, bool, kClassic, false);
IO_CONSTANT(4, int, kFalloff, 1);  // FalloffKind
IO_CONSTANT(5, bool, kChord, true);
IO_CONSTANT(6, int, kSums, 0);    // SliceSums
IO_CONSTANT(7, int, kMatter, 0);  // view::Matter
OBSCURA_MATTER_KINDS;
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
// Per direction cosine, sine and shift; the same per pixel of the tile; rho's table.
IO_READS(2, Tables, float, tables);
IO_WRITES(3, Open, float, open_sums);  // without directions the open share alone
IO_WRITES(4, Directions, vec4, sums);
IO_READS(5, Back, float, backs);  // of kWithBack
IO_PUSH(OBSCURA_RHO_WORDS float bias_sine; float bias_cosine;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_HORIZON_HORIZON_IO_H_
