#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MATTER_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MATTER_IO_H_

#include "screen/far_field/evaluation_io.h"

IO_BEGIN(far_field_matter_io)
OBSCURA_EVALUATION;
IO_READS(4, Back, float, backs);
IO_READS(5, Lines, vec4, lines);  // nearest, slanted, deepest, end; front, back, filled of the rest
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_MATTER_IO_H_
