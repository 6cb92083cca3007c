#ifndef OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_IO_H_
#define OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_IO_H_

#include "gpu/io.h"
#include "view/matter_io.h"

IO_BEGIN(hemisphere_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kSamples, 8);
IO_CONSTANT(1, int, kTests, 4);
IO_CONSTANT(2, int, kInterleave, 4);
IO_CONSTANT(3, bool, kQuadratic, false);
IO_CONSTANT(4, int, kMatter, 0);  // view::Matter
OBSCURA_MATTER_KINDS;
IO_CONSTANT(5, bool, kOpen, true);    // visibility goes to open_sums
IO_CONSTANT(6, bool, kCosine, true);  // its weights
IO_CONSTANT(7, bool, kDirections, false);
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
// Per sample cosine and sine of its azimuth and the offset of its tests; kTileValues of each pixel
// of the tile (TileValue).
IO_READS(2, Tables, float, tables);
IO_WRITES(3, Open, float, open_sums);
IO_WRITES(4, Directions, vec4, sums);
IO_READS(5, Back, float, backs);  // of kWithBack
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_HEMISPHERE_HEMISPHERE_IO_H_
