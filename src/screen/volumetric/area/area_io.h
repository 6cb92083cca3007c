#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_AREA_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_AREA_IO_H_

#include "screen/volumetric/sampling_io.h"

IO_BEGIN(area_io)
IO_THREADS(8, 8);
OBSCURA_VISIBILITY_TARGET;
OBSCURA_SAMPLING;
IO_CONSTANT(7, bool, kQuadratic, false);
IO_CONSTANT(8, int, kFullLevels, 2);
IO_READS(5, Moments, uvec2, moments);
// Where the pattern starts in the tables: x, y, lateral, extent, half, weight, level. Where the
// levels start, and how many there are: where each starts (bits) and its kernel's deviation in
// pixels.
IO_PUSH(int pattern; int levels; int level_count; float slack;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_AREA_IO_H_
