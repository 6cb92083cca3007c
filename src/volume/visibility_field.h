#ifndef OBSCURA_SRC_VOLUME_VISIBILITY_FIELD_H_
#define OBSCURA_SRC_VOLUME_VISIBILITY_FIELD_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "obscura/volume.h"
#include "volume/grid_sampler.h"
#include "volume/transport.h"

namespace obscura {

// The octant of the light in the turned grid of a shadow.
inline constexpr unsigned kShadowOctant = 7;

// A position among the voxels of a grid.
struct Place {
  int index[3][2];      // the voxels beside it, those within the grid
  float share[3][2];    // of either
  float outside[3][2];  // voxels beyond the outermost, on the low and the high side, at most 1

  int corner(int corner, int axis) const { return index[axis][corner >> axis & 1]; }
  float corner_share(int corner) const {
    return share[0][corner & 1] * share[1][corner >> 1 & 1] * share[2][corner >> 2];
  }
  // Share that the voxels inside the grid have in the visibility, for light from an octant. Outside
  // the grid, space is open on the side of the light; on the other side the voxels at the border
  // are repeated.
  float within(int octant) const {
    float w = 1;
    for (int a = 0; a < 3; ++a) w *= 1 - outside[a][octant >> a & 1];
    return w;
  }
};

// The visibilities. The channels of octant s are stored together, in half s >> 2.
class VisibilityFieldImpl {
 public:
  Transport transport{};
  TransportScheme scheme;
  std::shared_ptr<const PlaneTable> plane;
  std::array<int, 3> size{};
  Vec3 spacing{}, origin{};
  Vec3 end{};  // as far from the volume's end as `origin` is from its start
  float alpha = 1;
  bool shadow = false;
  Vec3 turned[3]{};  // shadow: axes of the grid in the volume's space
  std::unique_ptr<std::uint8_t[]> bytes[2];
  std::unique_ptr<float[]> floats[2];

  int directions() const { return static_cast<int>(scheme.directions.size()); }
  std::size_t voxels() const {
    return static_cast<std::size_t>(size[0]) * size[1] * static_cast<std::size_t>(size[2]);
  }
  std::size_t channels() const { return 4 * scheme.directions.size(); }
  // Takes another field's table if it is the same.
  bool take_plane(const VisibilityFieldImpl& other) {
    if (!other.plane || other.transport != transport || other.spacing != spacing ||
        other.alpha != alpha) {
      return false;
    }
    plane = other.plane;
    return true;
  }
  // Takes another field's memory if it fits, so that sweeping a volume again allocates nothing
  // large.
  void take_bytes(VisibilityFieldImpl* other) {
    if (other->voxels() * other->channels() != voxels() * channels()) return;
    for (int half = 0; half < 2; ++half) bytes[half] = std::move(other->bytes[half]);
    *other = {};
  }
  bool has_half(int half) const { return bytes[half] || floats[half]; }

  // First channel of an octant in its half, and in all channels of both.
  int first_channel(int octant) const { return kSlotOfQuadrant[octant & 3] * directions(); }
  int first_of_all(int octant) const {
    return (octant >> 2) * static_cast<int>(channels()) + first_channel(octant);
  }

  // Adds share times the values of half a voxel's channels, in [0, 1], to sum.
  void add(int half, std::size_t voxel, float share, float* sum) const {
    const std::size_t at = voxel * channels();
    const int n = static_cast<int>(channels());
    if (bytes[half]) {
      const std::uint8_t* v = bytes[half].get() + at;
      share *= 1.0f / 255;
      for (int c = 0; c < n; ++c) sum[c] += share * static_cast<float>(v[c]);
    } else {
      const float* v = floats[half].get() + at;
      for (int c = 0; c < n; ++c) sum[c] += share * v[c];
    }
  }

  // Where a position of the field's own space lies among its voxels.
  Place place(const Vec3& p) const {
    Place at;
    for (int a = 0; a < 3; ++a) {
      const float u = (p[a] - origin[a]) / spacing[a], last = static_cast<float>(size[a] - 1);
      const float inside = std::clamp(u, 0.0f, last);
      const int i = std::min(static_cast<int>(inside), std::max(0, size[a] - 2));
      at.index[a][0] = i;
      at.index[a][1] = std::min(i + 1, size[a] - 1);
      at.share[a][1] = inside - static_cast<float>(i);
      at.share[a][0] = 1 - at.share[a][1];
      at.outside[a][0] = std::clamp(-u, 0.0f, 1.0f);
      at.outside[a][1] = std::clamp((p[a] - end[a]) / spacing[a], 0.0f, 1.0f);
    }
    return at;
  }

  // All channels at a place, trilinearly.
  void sample(const Place& at, int halves, float* sum) const {
    std::fill_n(sum, 2 * channels(), 0.0f);
    for (int corner = 0; corner < 8; ++corner) {
      const float s = at.corner_share(corner);
      if (s == 0) continue;
      const auto voxel = static_cast<std::size_t>(at.corner(corner, 0)) +
                         size[0] * (static_cast<std::size_t>(at.corner(corner, 1)) +
                                    static_cast<std::size_t>(size[1]) * at.corner(corner, 2));
      for (int half = 0; half < 2; ++half) {
        if (halves >> half & 1) add(half, voxel, s, sum + half * channels());
      }
    }
  }

  // Heights of the voxels there above the plane through a point of the surface.
  PlaneTable::Heights heights(const Place& at, const SurfacePoint& point) const {
    PlaneTable::Heights result(*plane);
    for (int corner = 0; corner < 8; ++corner) {
      const float s = at.corner_share(corner);
      if (s == 0) continue;
      float height = 0;
      for (int a = 0; a < 3; ++a) {
        height +=
            point.normal[a] *
            (origin[a] + spacing[a] * static_cast<float>(at.corner(corner, a)) - point.position[a]);
      }
      result.add(height, s);
    }
    return result;
  }
};

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_VISIBILITY_FIELD_H_
