#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_GATHER_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_GATHER_IO_H_

#include "screen/far_field/totals_io.h"

IO_BEGIN(far_field_gather_io)
IO_THREADS(32, 4);
OBSCURA_TOTALS;
IO_CONSTANT(3, int, kSide, 2);  // of the groups, in pixels
IO_CONSTANT(4, int, kTilePixels, 32);
IO_READS(3, Depth, float, depth);
IO_READS(4, Totals, float, totals);
IO_READS(5, Dense, uint, dense);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_GATHER_IO_H_
