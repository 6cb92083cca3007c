#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SUM_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SUM_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_sum_io)
IO_THREADS(256, 1);
IO_TILE(1, 1);  // a strip per group
IO_READS(0, Tables, uvec4, quads);
IO_READS(1, Raw, vec2, raw);
IO_WRITES(2, Sums, vec2, sums);  // depth, outward
IO_WRITES(3, Counts, float, counts);
IO_PUSH(int rows; int line_stride; int sum_stride; int phases; float slope;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SUM_IO_H_
