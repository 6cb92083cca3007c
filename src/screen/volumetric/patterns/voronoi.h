#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_VORONOI_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_VORONOI_H_

#include <array>
#include <span>
#include <vector>

namespace obscura::math {

using Point = std::array<double, 3>;  // z is 0 in the disk

// What a Voronoi cell holds.
struct VoronoiCell {
  double constant = 0;   // integral of the density for rho = 1
  double quadratic = 0;  // and for rho = (1 - r)^2
  Point centroid = {};   // weighted by the first
};

// Discrete Voronoi diagrams of the unit disk, whose density is the line integral of rho through the
// sphere, or of the unit ball, on a grid of `resolution` cells along the diameter.
class VoronoiGrid {
 public:
  VoronoiGrid(bool ball, int resolution);

  std::vector<VoronoiCell> cells(std::span<const Point> points) const;

 private:
  std::vector<float> x_, y_, z_, constant_, quadratic_;
};

}  // namespace obscura::math

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_VORONOI_H_
