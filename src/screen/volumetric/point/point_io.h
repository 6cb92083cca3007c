#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_POINT_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_POINT_IO_H_

#include "screen/volumetric/sampling_io.h"

IO_BEGIN(point_io)
IO_THREADS(8, 8);
OBSCURA_VISIBILITY_TARGET;
OBSCURA_SAMPLING;
// Where the pattern starts in the tables: x, y, z, weight.
IO_PUSH(int pattern;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_POINT_IO_H_
