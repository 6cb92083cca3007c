#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_RANGE_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_RANGE_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_range_io)
IO_THREADS(256, 1);
IO_TILE(1, 1);  // as many groups as a pass's width, each of which leaves one value
IO_READS(0, Depth, float, depth);
IO_WRITES(1, Greatest, float, greatest);
IO_PUSH(int count; int last;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_RANGE_IO_H_
