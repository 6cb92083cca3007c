#ifndef OBSCURA_SRC_SCREEN_REFERENCE_PIXEL_TRACER_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_PIXEL_TRACER_H_

#include <cstdint>
#include <vector>

#include "obscura/reference.h"
#include "screen/reference/rays.h"
#include "view/geometry.h"

namespace obscura {

struct Pixel {
  int x, y;  // of the visible part
};

// What the rays of one weighting say about a pixel.
struct HemisphereEstimate {
  double visibility = 0;
  double direction[3] = {};  // mean of V w
  double radiance[3] = {};   // mean of V L, where it is asked for
  double standard_error = 0;
};

struct PixelEstimate {
  HemisphereEstimate cosine, uniform;
};

// One worker's means to trace pixels. The rays of a pixel are two independently scrambled nets; the
// azimuth is cut into the same slabs in both, and what the two find in one slab differs by its
// noise, which gives the standard error.
class PixelTracer {
 public:
  static constexpr int kMaxPixels = 32;

  struct Frame {
    const view::Geometry* geometry;
    const TraceScene* scene;
    const math::Rho* rho;
    const ReferenceSettings* settings;
    bool cosine, uniform;   // the weightings that are needed
    bool radiance = false;  // with `cosine`
  };

  // Traces at most kMaxPixels pixels with finite depth.
  void trace(const Frame& frame, const Pixel* pixels, int count, PixelEstimate* estimates);

 private:
  static constexpr int kMaxSlabs = 4;
  struct Sums {
    double open = 0, x = 0, y = 0, z = 0;
    double radiance[3] = {};
  };
  struct Slabs {
    Sums of[2][kMaxSlabs];
  };
  // Rays of the batch whose sums go to one place.
  struct Piece {
    Sums* to;
    int begin, end;
    bool lit;
  };

  void trace_set(const Frame& frame, const Receiver& receiver, bool uniform, std::uint32_t seed,
                 Slabs* slabs);
  void flush(const Frame& frame);

  RayBatch batch_{};
  std::vector<Piece> pieces_;
  Slabs slabs_[kMaxPixels][2];
};

// Where the rays of a pixel with finite depth start.
Receiver make_receiver(const PixelTracer::Frame& frame, Pixel pixel);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_PIXEL_TRACER_H_
