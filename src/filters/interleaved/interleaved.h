#ifndef OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_H_
#define OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_H_

#include <memory>
#include <vector>

#include "core/aligned_image.h"
#include "filters/interleaved/kernel.h"
#include "obscura/executor.h"
#include "obscura/outputs.h"
#include "view/geometry.h"

namespace obscura::interleaved {

// What the sums hold (kernel.h) and what becomes of them.
enum class Sums {
  kUniform,            // both by uniform weights
  kUniformDirections,  // `open` by cosine weights, directions by uniform ones: since
                       // n.(1/pi integral of V w) is the former, nothing else need be summed
  kCosine,             // both by cosine weights
  kRadiance,           // three channels of light
};
struct Resolve {
  Sums sums = Sums::kUniform;
  bool directions = false;    // all channels; else the first
  int interleave = 1;         // pixels m x m share a pattern; 1: no blur
  float edge = 0;             // surfaces farther apart are kept apart, world units
  float edges_per_depth = 0;  // at least as many edges lie in a pixel's depth; 0: any number
  bool paper_cone = false;
};

// Sums of an interleaved pattern and their way to results: a blur over the m x m pixels that share
// the pattern, edge-aware by depth and normal, then directions, cones and integrals.
class InterleavedSums {
 public:
  InterleavedSums();
  ~InterleavedSums();

  // Makes room for images of at most this size.
  void resize(int width, int height);

  // Where row y of a channel is written, whole vectors past the end too; finite on the background.
  float* row(int channel, int y);
  // To be called when a row is written.
  void close_row(int channels, int width, int y);

  void resolve(const view::Geometry& g, const Resolve& how, const Outputs& o, Executor& executor);

 private:
  struct Tile;

  void blur_tile(const view::Geometry& g, const Resolve& how, const Outputs& o, int x, int first,
                 int columns, int end, Tile* tile);
  static void load_row(const view::Geometry& g, int x, int columns, int y, int to, Tile* tile);
  static void write(const view::Geometry& g, const Resolve& how, const Outputs& o, int y, int x,
                    int count, const float* const sums[kChannels]);

  AlignedImage<float> sums_[kChannels];
  std::vector<std::unique_ptr<Tile>> tiles_;  // one per thread
};

}  // namespace obscura::interleaved

#endif  // OBSCURA_SRC_FILTERS_INTERLEAVED_INTERLEAVED_H_
