#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_COLLECT_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_COLLECT_IO_H_

#include "screen/far_field/totals_io.h"

IO_BEGIN(far_field_collect_io)
IO_NUMBER(kTile, 32);
IO_THREADS(32, 8);
IO_TILE(kTile, kTile);
OBSCURA_TOTALS;
IO_CONSTANT(3, bool, kToImage, true);
IO_READS(3, Straight, float, straight);
IO_READS(4, Turned, float, turned);
IO_UPDATES(5, Totals, float, totals);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_COLLECT_IO_H_
