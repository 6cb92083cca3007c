#ifndef OBSCURA_SRC_VIEW_WIDTHS_IO_H_
#define OBSCURA_SRC_VIEW_WIDTHS_IO_H_

#include "gpu/io.h"

IO_BEGIN(widths_io)
IO_NUMBER(kLines, 8);   // columns or rows of a group
IO_NUMBER(kParts, 32);  // of each, a thread for each part
IO_THREADS(8, 32);
IO_TILE(8, 1);
IO_CONSTANT(0, bool, kAcross, false);  // along rows, and then on to where matter ends; else down
IO_READS(0, Depth, float, depth);
IO_READS(1, Down, float, down);
IO_UPDATES(2, Runs, float, runs);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_VIEW_WIDTHS_IO_H_
