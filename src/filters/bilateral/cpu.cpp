#include "filters/bilateral/bilateral.h"

#include <algorithm>

#include "filters/bilateral/kernel.h"

namespace obscura {
namespace {

constexpr int kRowsPerTask = 8;
constexpr int kChunk = 1024;  // pixels between kernel and output; a multiple of every vector
constexpr int kVector = 16;   // the kernel may write so much past the end

// The taps of `at` that lie in [0, size).
void clip_taps(int at, int size, BilateralRow* row) {
  row->first_tap = -std::min(BilateralFilter::kReach, at);
  row->last_tap = std::min(BilateralFilter::kReach, size - 1 - at);
}

}  // namespace

void BilateralFilter::resize(int width, int height) {
  width_ = width;
  height_ = height;
  // Rounded up, as whole vectors are written at the end of a row, and still a margin after that.
  const int padded = (width + kVector - 1) / kVector * kVector + 2 * kMargin;
  for (AlignedImage<float>* image : {&input_, &surface_, &rows_}) {
    image->resize(padded, height);
    std::fill_n(image->data(), image->stride() * height, 0.0f);
  }
}

void BilateralFilter::run(const view::Geometry& g, float edge, Executor& executor,
                          const ImageView<float>& out) {
  const int tasks = (height_ + kRowsPerTask - 1) / kRowsPerTask;
  auto for_rows = [&](auto body) {
    executor.parallel_for(tasks, [&](int task, int) {
      const int end = std::min(height_, (task + 1) * kRowsPerTask);
      for (int y = task * kRowsPerTask; y < end; ++y) body(y);
    });
  };
  BilateralRow shared;
  shared.orthographic = g.camera.orthographic;
  shared.edge = edge;

  for_rows([&](int y) {
    float* surface = surface_.row(y) + kMargin;
    surface_row(g.depth.row(y + g.guard_band.top) + g.guard_band.left, width_,
                g.camera.orthographic, surface);
    // Margins are background, so a row needs no clipping.
    std::fill_n(surface + width_, kMargin, 0.0f);
    BilateralRow row = shared;
    row.values = input_.row(y) + kMargin;
    row.surface = surface;
    row.first_tap = -kReach;
    row.last_tap = kReach;
    bilateral_row(row, width_, rows_.row(y) + kMargin);
  });

  for_rows([&](int y) {
    float chunk[kChunk];
    BilateralRow row = shared;
    row.value_step = rows_.stride();
    row.surface_step = surface_.stride();
    clip_taps(y, height_, &row);
    for (int x = 0; x < width_; x += kChunk) {
      const int count = std::min(kChunk, width_ - x);
      row.values = rows_.row(y) + kMargin + x;
      row.surface = surface_.row(y) + kMargin + x;
      bilateral_row(row, count, chunk);
      for (int i = 0; i < count; ++i) out(x + i, y) = chunk[i];
    }
  });
}

}  // namespace obscura
