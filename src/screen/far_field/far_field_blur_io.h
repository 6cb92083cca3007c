#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_BLUR_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_BLUR_IO_H_

#include "screen/far_field/totals_io.h"

IO_BEGIN(far_field_blur_io)
IO_NUMBER(kWidth, 32);
IO_NUMBER(kHeight, 8);
IO_THREADS(kWidth, kHeight);
OBSCURA_TOTALS;
IO_READS(3, Depth, float, depth);
IO_READS(4, Totals, float, totals);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_BLUR_IO_H_
