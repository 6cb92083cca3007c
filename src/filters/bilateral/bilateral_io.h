#ifndef OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_IO_H_
#define OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_IO_H_

#include "gpu/io.h"

IO_BEGIN(bilateral_io)
IO_NUMBER(kTileWidth, 32);
IO_NUMBER(kTileHeight, 24);
IO_THREADS(128, 1);
IO_TILE(kTileWidth, kTileHeight);
IO_READS(0, Depth, float, depth);
IO_READS(1, Values, float, values);
IO_VISIBILITY(2);
IO_PUSH(float edge;);
IO_END

#endif  // OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_IO_H_
