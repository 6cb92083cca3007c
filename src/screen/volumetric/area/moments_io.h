#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_IO_H_

#include "gpu/io.h"

IO_BEGIN(moments_io)
IO_NUMBER(kTile, 16);
IO_THREADS(128, 1);
IO_TILE(kTile, kTile);
IO_CONSTANT(0, bool, kFirst, true);  // from depth
IO_READS(0, Depth, float, depth);
IO_UPDATES(1, Moments, uvec2, moments);
// Of the level before: where it is, its row's length, and 2 where every other texel is kept. Of
// this one: where it goes, its size, and the distance of taps.
IO_PUSH(int from; int from_width; int keep; int to; int to_width; int to_height; int tap_step;
        float slack;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_IO_H_
