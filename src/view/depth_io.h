#ifndef OBSCURA_SRC_VIEW_DEPTH_IO_H_
#define OBSCURA_SRC_VIEW_DEPTH_IO_H_

#include "gpu/io.h"

IO_BEGIN(depth_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kDepthKind, 0);  // DepthKind
IO_IMAGE(0, DepthImage, depth_image);
IO_WRITES(1, Depth, float, depth);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_VIEW_DEPTH_IO_H_
