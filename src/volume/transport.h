#ifndef OBSCURA_SRC_VOLUME_TRANSPORT_H_
#define OBSCURA_SRC_VOLUME_TRANSPORT_H_

#include <vector>

#include "obscura/volume.h"
#include "volume/occlusion_kernel.h"

namespace obscura {

// What a transport is made of.
struct TransportScheme {
  int cell = 1;        // voxels of the volume along a side of a voxel of its grid
  bool plane = false;  // visibilities are divided by those of the plane with the point's normal
  float lookup = 0;    // voxels of its grid along the normal from the point to the look-up
  std::vector<SweepDirection> directions{};  // of the octant from (+, +, +)
};
// `spacing` is the volume's.
TransportScheme transport_scheme(Transport transport, const std::array<float, 3>& spacing);

// Visibility that a scheme itself gives above an unoccluded plane, at the height of its look-up,
// over the plane's normal: the scheme in one dimension. Tabulated on the octahedron of normals.
class PlaneTable {
 public:
  PlaneTable() = default;
  // `spacing` is of the scheme's grid, `unit` what tau is measured in (equation 7).
  PlaneTable(const TransportScheme& scheme, const std::array<float, 3>& spacing, float unit,
             float alpha, Executor& executor);

  bool empty() const { return values_.empty(); }
  // Of every direction, for a normal whose signs were multiplied by the octant's.
  void look_up(const std::array<float, 3>& normal, float* values) const;

 private:
  int count_ = 0;
  std::vector<float> values_;
};

// G_s(N) of equation 5 in closed form: Lambert's formula for the octant's triangle on the unit
// sphere, clipped at the horizon. The eight sum to pi.
float octant_geometry(const std::array<float, 3>& normal, int octant);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_TRANSPORT_H_
