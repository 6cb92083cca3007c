#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_LINE_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_LINE_IO_H_

#include "screen/volumetric/sampling_io.h"

IO_BEGIN(line_io)
IO_THREADS(8, 8);
OBSCURA_VISIBILITY_TARGET;
OBSCURA_SAMPLING;
IO_CONSTANT(7, bool, kQuadratic, false);
IO_CONSTANT(8, bool, kTangent, false);
// Where the pattern starts in the tables: x, y, lateral, extent, half, weight.
IO_PUSH(int pattern;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_LINE_IO_H_
