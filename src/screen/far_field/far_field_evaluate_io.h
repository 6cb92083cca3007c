#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_EVALUATE_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_EVALUATE_IO_H_

#include "screen/far_field/evaluation_io.h"

IO_BEGIN(far_field_evaluate_io)
OBSCURA_EVALUATION;
IO_READS(4, LineSums, vec2, line_sums);
IO_READS(5, Counts, float, counts);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_EVALUATE_IO_H_
