#ifndef OBSCURA_SRC_LIGHTING_RADIANCE_MAP_H_
#define OBSCURA_SRC_LIGHTING_RADIANCE_MAP_H_

#include <array>
#include <vector>

#include "lighting/cube_grid.h"

namespace obscura::lighting {

// Adds up light on a cube's vertices. Each sample is shared among the four vertices around it, so
// that the vertices' solid angles and energies sum to what was put in.
class LightSum {
 public:
  explicit LightSum(CubeGrid grid) : grid_(grid), sums_(grid.vertices()) {}

  void add(const std::array<float, 3>& direction, double solid_angle, double r, double g, double b);
  void add(const LightSum& other);

  struct Sample {
    std::array<double, 3> energy{};  // radiance times solid angle
    double solid_angle = 0;
  };
  CubeGrid grid() const { return grid_; }
  // Moves what vertices on edges have gathered to the faces that own them.
  void gather_edges();
  const std::vector<Sample>& samples() const { return sums_; }

 private:
  CubeGrid grid_;
  std::vector<Sample> sums_;
};

// Radiance by direction, bilinear between a cube's vertices.
struct RadianceMap {
  struct Texel {
    float r = 0, g = 0, b = 0;
    float solid_angle = 0;  // 0 on vertices that another face owns
  };
  CubeGrid grid{0};
  std::vector<Texel> texels;

  RadianceMap() = default;
  explicit RadianceMap(LightSum sum);  // every vertex has received some light, if black

  std::array<float, 3> radiance(const std::array<float, 3>& direction) const;
  // The same light on fewer vertices.
  RadianceMap coarser(CubeGrid to) const;
};

}  // namespace obscura::lighting

#endif  // OBSCURA_SRC_LIGHTING_RADIANCE_MAP_H_
