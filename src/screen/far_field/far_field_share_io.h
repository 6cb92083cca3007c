#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SHARE_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SHARE_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_share_io)
IO_THREADS(32, 4);
IO_TILE(1, 1);
IO_CONSTANT(0, int, kSide, 2);  // of the groups, in pixels
IO_CONSTANT(1, int, kTilePixels, 32);
IO_CONSTANT(2, int, kRowStep, 2);  // rows that are looked at
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
IO_WRITES(2, Dense, uint, dense);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SHARE_IO_H_
