#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MERGE_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MERGE_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_merge_io)
IO_THREADS(32, 8);
IO_READS(0, Tables, uvec4, quads);
IO_UPDATES(1, Pieces, vec4, pieces);
IO_PUSH(int transposed; int merges; int line_stride;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MERGE_IO_H_
