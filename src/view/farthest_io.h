#ifndef OBSCURA_SRC_VIEW_FARTHEST_IO_H_
#define OBSCURA_SRC_VIEW_FARTHEST_IO_H_

#include "gpu/io.h"

IO_BEGIN(farthest_io)
IO_THREADS(128, 1);
IO_TILE(1, 1);  // as many groups as a pass's width, each of which leaves one value
IO_READS(0, Depth, float, depth);
IO_WRITES(1, Farthest, float, farthest);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_VIEW_FARTHEST_IO_H_
