#ifndef OBSCURA_SRC_VOLUME_TRANSPORT_H_
#define OBSCURA_SRC_VOLUME_TRANSPORT_H_

#include <vector>

#include "obscura/volume.h"
#include "volume/occlusion_kernel.h"

namespace obscura {

// The parts of a transport scheme.
struct TransportScheme {
  int cell = 1;        // voxels of the volume along a side of a voxel of its grid
  bool plane = false;  // visibilities are divided by those above a plane with the point's normal
                       // (PlaneTable)
  float lookup = 0;    // voxels of its grid along the normal from the point to the look-up
  std::vector<SweepDirection> directions{};  // of the octant from (+, +, +)
};
// `spacing` is the volume's.
TransportScheme transport_scheme(Transport transport, const std::array<float, 3>& spacing);

// Visibility that a scheme gives above an unoccluded plane, for every normal of the plane and
// height above it. It depends on the height only, so that the scheme is solved in one dimension.
// Normals are tabulated on an octahedral map.
class PlaneTable {
 public:
  static constexpr int kHeights = 25;
  static constexpr int kRoom = (kMaxDirections + 3) / 4 * 4;  // for the values of a look-up

  // Heights of the voxels between which a look-up interpolates, with their shares.
  class Heights {
   public:
    Heights() = default;
    explicit Heights(const PlaneTable& table) : per_height_(table.per_height_) {}
    void add(float height, float share);

   private:
    friend PlaneTable;
    float per_height_ = 0;
    int first_ = kHeights, last_ = -1;
    float share_[kHeights] = {};
  };

  // `spacing` is of the scheme's grid, `unit` what tau is measured in (equation 7).
  PlaneTable(const TransportScheme& scheme, const std::array<float, 3>& spacing, float unit,
             float alpha, Executor& executor);

  // Of every direction, for a normal whose signs were multiplied by the octant's.
  void look_up(const std::array<float, 3>& normal, const Heights& heights,
               float values[kRoom]) const;

 private:
  std::size_t node(int column, int row) const;
  // Values at the heights' mean, between four normals.
  template <int kPitch>
  static void mix(const float* const nodes[4], const float share[4], const Heights& heights,
                  float* values);

  int pitch_ = 0;  // floats from height to height
  float per_height_ = 0;
  std::vector<float> values_;
};

// G_s(N) of equation 5 in closed form: Lambert's formula for the octant's triangle on the unit
// sphere, clipped at the horizon. The eight sum to pi.
float octant_geometry(const std::array<float, 3>& normal, int octant);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_TRANSPORT_H_
