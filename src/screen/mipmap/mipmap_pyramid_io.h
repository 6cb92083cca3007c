#ifndef OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_PYRAMID_IO_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_PYRAMID_IO_H_

#include "gpu/io.h"

IO_BEGIN(mipmap_pyramid_io)
IO_NUMBER(kTile, 32);
IO_NUMBER(kLevelsPerPass, 5);
IO_THREADS(256, 1);
IO_TILE(kTile, kTile);
IO_CONSTANT(0, bool, kMean, true);
IO_READS(0, Tables, uvec4, quads);
IO_READS(1, Depth, float, depth);
IO_UPDATES(2, Pyramid, float, pyramid);
IO_PUSH(int levels; int source; int count;);  // the levels' table; from which level; of how many
IO_END

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_PYRAMID_IO_H_
