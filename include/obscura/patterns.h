#ifndef OBSCURA_PATTERNS_H_
#define OBSCURA_PATTERNS_H_

#include <cstdint>
#include <span>
#include <vector>

#include "obscura/export.h"
#include "obscura/settings.h"

namespace obscura {

// Sample patterns of volumetric obscurance (Loos and Sloan 2010, section 4.5).

// A sample of the unit disk, the projection of the unit sphere along the view direction: one line
// or area sample. The weights are the integrals, over the sample's Voronoi cell in the disk, of the
// line integral of rho through the sphere: rho = 1, and rho = (1 - r)^2. Over a pattern they sum to
// the whole integrals, 4 pi / 3 and 2 pi / 15.
struct DiskSample {
  float x, y;
  float weight_constant;
  float weight_quadratic;
};

// A sample of the unit ball; the weights are the integrals of rho over its Voronoi cell.
struct BallSample {
  float x, y, z;
  float weight_constant;
  float weight_quadratic;
};

// The patterns that ship with the library, made by the functions below with their default seed.
inline constexpr int kMaxDiskSamples = 32;
inline constexpr int kMaxBallSamples = 64;
OBSCURA_API std::span<const DiskSample> disk_pattern(int count, bool center);  // count in [1, 32]
OBSCURA_API std::span<const BallSample> ball_pattern(int count);               // count in [1, 64]

// How patterns are made: points repel each other with 1/d^4, and a charge on the boundary, adapted
// so that points move to the weighted centroids of their Voronoi cells, keeps them inside. A step
// is kept while the error falls. Of many Poisson starts the one with the least integration error
// over half-spaces and steps wins.
struct OBSCURA_EXPERIMENTAL PatternSettings {
  int count = 9;
  bool center = false;
  int starts = 32;
  int steps = 200;
  std::uint32_t seed = 1;
};
template <FieldsOf<PatternSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.count, Field{"count", "samples", closed(1, 256), "Samples in the pattern."});
  v(s.center, Field{"center", "", {}, "Keep one sample of a disk at the centre."});
  v(s.starts,
    Field{"starts", "", closed(1, 10000), "Random starting sets; the best result is taken."});
  v(s.steps, Field{"steps", "", closed(1, 100000), "Steps taken from each start."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

OBSCURA_API OBSCURA_EXPERIMENTAL Status make_disk_pattern(const PatternSettings& settings,
                                                          std::vector<DiskSample>* pattern);
OBSCURA_API OBSCURA_EXPERIMENTAL Status make_ball_pattern(const PatternSettings& settings,
                                                          std::vector<BallSample>* pattern);

// Sets the weights of any set of samples from its Voronoi cells, on a grid of 512^2 or 128^3.
OBSCURA_API OBSCURA_EXPERIMENTAL void weigh(std::span<DiskSample> samples);
OBSCURA_API OBSCURA_EXPERIMENTAL void weigh(std::span<BallSample> samples);

}  // namespace obscura

#endif  // OBSCURA_PATTERNS_H_
