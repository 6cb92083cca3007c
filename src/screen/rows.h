#ifndef OBSCURA_SRC_SCREEN_ROWS_H_
#define OBSCURA_SRC_SCREEN_ROWS_H_

#include <algorithm>

#include "screen/method.h"

namespace obscura {

// Runs a kernel over the visible rows in bands and writes what it gives to an image of any strides.
// kernel(row, begin, end, out) writes pixels [begin, end) of a row; `begin` is a multiple of 64.
template <class Kernel>
Status run_rows(const view::Geometry& g, const ImageView<float>& image, const RunContext& context,
                Kernel kernel) {
  constexpr int kRowsPerTask = 8, kChunk = 1024;
  const int width = g.visible().width, height = g.visible().height;
  Progress progress(height, context.progress);
  context.executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
    if (progress.cancelled()) return;
    const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
    for (int y = first; y < end; ++y) {
      if (image.pixel_stride == 1) {
        kernel(y, 0, width, &image(0, y));
        continue;
      }
      float chunk[kChunk];
      for (int x = 0; x < width; x += kChunk) {
        const int stop = std::min(width, x + kChunk);
        kernel(y, x, stop, chunk);
        for (int i = x; i < stop; ++i) image(i, y) = chunk[i - x];
      }
    }
    progress.advance(end - first);
  });
  if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
  return {};
}

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_ROWS_H_
