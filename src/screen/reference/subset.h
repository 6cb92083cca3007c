#ifndef OBSCURA_SRC_SCREEN_REFERENCE_SUBSET_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_SUBSET_H_

#include <vector>

#include "obscura/outputs.h"
#include "screen/reference/pixel_tracer.h"
#include "view/geometry.h"

namespace obscura {

// Every n-th visible pixel of every n-th row, from n/2.
class Subset {
 public:
  Subset(const view::Geometry& geometry, int every) : g_(geometry), every_(every) {}

  // The chosen pixels that have a surface.
  void choose(std::vector<Pixel>* pixels) const;

  // Writes NaN to all other pixels that have a surface.
  void fill_with_nan(const Outputs& outputs, Executor& executor) const;

  // Writes to them a mean of the four chosen pixels around, of which the nearer ones and those of
  // like depth weigh more. Those without any such neighbour are left alone, and returned.
  void interpolate(const Outputs& outputs, Executor& executor, std::vector<Pixel>* orphans) const;

 private:
  struct Blend {
    Pixel pixel[4];
    float weight[4];  // sum 1
    int count = 0;
  };
  bool has_surface(int x, int y) const;
  Blend neighbours(int x, int y) const;
  bool chosen(int x, int y) const { return x % every_ == every_ / 2 && y % every_ == every_ / 2; }

  const view::Geometry& g_;
  const int every_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_SUBSET_H_
