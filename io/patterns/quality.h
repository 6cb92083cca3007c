#ifndef OBSCURA_IO_PATTERNS_QUALITY_H_
#define OBSCURA_IO_PATTERNS_QUALITY_H_

#include <cstdint>
#include <span>
#include <vector>

#include "obscura/patterns.h"

namespace obscura::tools {

// How well a pattern integrates what depth images look like from near by: root mean square error of
// the free share of the sphere, in per cent of the sphere, over random half-spaces (tilted planes)
// and random steps (one depth on one side of an edge, open on the other), both at random
// orientations, which stand for the random reflection per pixel as well.
struct PatternQuality {
  double half_spaces = 0;
  double steps = 0;
  double both() const;  // root of the mean of the squares
};
PatternQuality quality(std::span<const DiskSample> lines);   // as line samples
PatternQuality quality(std::span<const BallSample> points);  // as point samples

// Well-known sets of the same size, with Voronoi weights. Poisson and stratified sets are random:
// `seed` picks one. Points are spread evenly over the disk or ball, or, if `by_density`, in
// proportion to the sphere's extent (disk only).
enum class RivalPattern { kPoisson, kStratified, kHammersley, kR2 };
inline constexpr const char* kRivalNames[] = {"poisson", "stratified", "hammersley", "r2"};
std::vector<DiskSample> rival_disk(RivalPattern rival, int count, bool by_density,
                                   std::uint32_t seed);
std::vector<BallSample> rival_ball(RivalPattern rival, int count, std::uint32_t seed);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PATTERNS_QUALITY_H_
