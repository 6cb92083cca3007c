#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_AVERAGE_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_AVERAGE_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_average_io)
IO_THREADS(32, 4);
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
IO_WRITES(2, Groups, vec4, groups);      // normal, depth
IO_WRITES(3, Accepted, uint, accepted);  // bit 3 (dy + 1) + dx + 1
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_AVERAGE_IO_H_
