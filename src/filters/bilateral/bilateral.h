#ifndef OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_H_
#define OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_H_

#include "core/aligned_image.h"
#include "obscura/executor.h"
#include "obscura/views.h"
#include "view/geometry.h"

namespace obscura {

// Edge-aware blur of one channel, separable: along rows, then along columns, 9 pixels each, with
// binomial weights. A tap counts the less, the farther its surface lies from where the receiver's
// surface would go on: 1/depth is linear on a plane in perspective, depth itself in a parallel
// view, so the receiver's surface is continued by the one-sided difference with the smaller change,
// and a slanted floor is blurred like a wall. Background neither gives nor takes.
//
// A constant stays that constant, exactly. The result never leaves the range of its inputs by more
// than rounding.
class BilateralFilter {
 public:
  // Half the filter's width in pixels.
  static constexpr int kReach = 4;

  // Makes room for images of at most this size.
  void resize(int width, int height);
  // The size of the visible part of the coming images; allocates nothing.
  void set_size(int width, int height) {
    width_ = width;
    height_ = height;
  }

  // Where the caller writes the image to blur, finite on the background too.
  ImageView<float> input() { return {input_.data() + kMargin, width_, height_, input_.stride()}; }

  // Blurs the visible part of `geometry` into `out`. Surfaces farther apart than `edge` (world
  // units) are kept apart.
  void run(const view::Geometry& geometry, float edge, Executor& executor,
           const ImageView<float>& out);

 private:
  static constexpr int kMargin = 16;  // left and right of each row; never written

  int width_ = 0, height_ = 0;
  AlignedImage<float> input_;    // with margins
  AlignedImage<float> surface_;  // 1/depth or depth, with margins of background
  AlignedImage<float> rows_;     // after the first direction
};

}  // namespace obscura

#endif  // OBSCURA_SRC_FILTERS_BILATERAL_BILATERAL_H_
