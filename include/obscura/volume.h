#ifndef OBSCURA_VOLUME_H_
#define OBSCURA_VOLUME_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "obscura/export.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"
#include "obscura/status.h"

// Ambient visibility in volumes (Singh, Yuksel and House 2011, fast occlusion sweeping): the signed
// distance to an isosurface by fast sweeping, visibility by sweeps from eight octants, and a Monte
// Carlo reference through the same field. Arrays in, arrays out.
//
// Grid space: voxel (i, j, k) is the point (i * spacing[0], j * spacing[1], k * spacing[2]); the
// volume's axes are those of the space. Between voxels a field is interpolated trilinearly; outside
// the outermost voxels' centres the volume is open.

namespace obscura {

enum class VoxelType { kU8, kI16, kU16, kF32 };
template <>
struct EnumNames<VoxelType> {
  static constexpr const char* names[] = {"u8", "i16", "u16", "f32"};
};

// Caller-owned scalar samples; a voxel's value is slope * sample + intercept. A voxel that is NaN
// is open.
struct VolumeView {
  const void* data = nullptr;
  VoxelType type = VoxelType::kF32;
  std::array<int, 3> size{};              // voxels along x, y and z, each in [1, 8192]
  std::array<float, 3> spacing{1, 1, 1};  // world units between voxels' centres, (0, inf)
  // In samples, from one voxel to the next along x, y and z; all zero: dense, x fastest.
  std::array<std::ptrdiff_t, 3> stride{};
  float slope = 1, intercept = 0;
};

// Caller-owned grid of T, written or read; strides as in VolumeView.
template <class T>
struct GridView {
  T* data = nullptr;
  std::array<int, 3> size{};
  std::array<float, 3> spacing{1, 1, 1};
  std::array<std::ptrdiff_t, 3> stride{};

  GridView() = default;
  GridView(T* d, std::array<int, 3> n, std::array<float, 3> h, std::array<std::ptrdiff_t, 3> s = {})
      : data(d), size(n), spacing(h), stride(s) {}
  template <class U>
  requires(sizeof(U) == sizeof(T))
      GridView(const GridView<U>& o)  // from a mutable view to a const one
      : GridView(o.data, o.size, o.spacing, o.stride) {}

  std::array<std::ptrdiff_t, 3> strides() const {
    if (stride[0] || stride[1] || stride[2]) return stride;
    return {1, size[0], static_cast<std::ptrdiff_t>(size[0]) * size[1]};
  }
};

// Which side of the isovalue blocks light.
enum class SolidSide { kAbove, kBelow };
template <>
struct EnumNames<SolidSide> {
  static constexpr const char* names[] = {"above", "below"};
};

// How distances next to the surface are found.
enum class DistanceStart {
  kGradient,  // |f| / |grad f|, capped by the distance along the crossing edges: most accurate
  kEdges,     // the paper's: interpolation along the crossing edges
};
template <>
struct EnumNames<DistanceStart> {
  static constexpr const char* names[] = {"gradient", "edges"};
};

struct DistanceSettings {
  float isovalue = 0;
  SolidSide solid = SolidSide::kAbove;
  DistanceStart start = DistanceStart::kGradient;
  int sweeps = 8;
  bool converge = false;
};
template <FieldsOf<DistanceSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.isovalue, Field{"isovalue",
                      "value",
                      {-3.4e38, 3.4e38},
                      "Isovalue: the value on the surface; a voxel of this value is matter."});
  v(s.solid, Field{"solid", "", {}, "Which side of the isovalue is matter."});
  v(s.start, Field{"start", "", {}, "How distances next to the surface are found."});
  v(s.sweeps,
    Field{"sweeps", "", closed(8, 800), "Sweeps at most, rounded up to a multiple of eight."});
  v(s.converge,
    Field{"converge", "", {}, "Continue after these sweeps until nothing changes, up to 800."});
}

struct DistanceReport {
  int sweeps = 0;          // done
  bool converged = false;  // the last round changed nothing (known with `converge` only)
};

// Writes the signed distance to the isosurface, in world units, positive in the open and negative
// in matter (equation 1, solved for unequal spacing too). Sweeps carry |D| outward from the voxels
// beside the surface; the sign is the voxel's own.
//
// Guarantees: the same bits for any number of threads. An axis may be one voxel long. Refuses, with
// the range of values in the message, a volume that the isovalue does not cut.
// Requires: `distance` as large as the volume and not overlapping it; its spacing is not read.
OBSCURA_API Status sweep_distance(const VolumeView& volume, const DistanceSettings& settings,
                                  GridView<float> distance, const RunOptions& run = {},
                                  DistanceReport* report = nullptr);

// Range and mean of a volume's values; NaN left out.
struct VolumeRange {
  float min = 0, max = 0;
  double mean = 0;
  std::int64_t finite = 0, not_finite = 0;
};
// Guarantees: the same bits for any number of threads.
OBSCURA_API Status volume_range(const VolumeView& volume, VolumeRange* range,
                                const RunOptions& run = {});

// Converts one row of values, x = 0 ... size[0] - 1, to floats.
OBSCURA_API void volume_row(const VolumeView& volume, int y, int z, float* values);

enum class Transport {
  kPaper,     // equation 6 on the full grid
  kFast,      // half resolution, three directions per octant
  kBalanced,  // half resolution, six directions per octant
  kAccurate,  // half resolution, ten directions per octant
};
template <>
struct EnumNames<Transport> {
  static constexpr const char* names[] = {"paper", "fast", "balanced", "accurate"};
};

enum class VisibilityPrecision { kU8, kF32 };
template <>
struct EnumNames<VisibilityPrecision> {
  static constexpr const char* names[] = {"u8", "f32"};
};

struct OcclusionSettings {
  Transport transport = Transport::kBalanced;
  VisibilityPrecision precision = VisibilityPrecision::kU8;
  float alpha = 1;  // equation 8
};
template <FieldsOf<OcclusionSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.transport,
    Field{"transport", "", {}, "Scheme by which visibility is carried through the grid."});
  v(s.precision, Field{"precision", "", {}, "How visibilities are stored."});
  v(s.alpha, Field{"alpha", "", closed(0, 1), "Opacity of matter; below 1 light passes through."});
}

// A point of the surface: its position in grid space and the unit normal towards the open side.
struct SurfacePoint {
  std::array<float, 3> position;
  std::array<float, 3> normal;
};

// Octants are numbered as in the paper's Table 1, from 0: bit 0, 1 or 2 set means that the light
// comes from the positive side of x, y or z (0 is light from (-, -, -), 7 from (+, +, +)).
inline constexpr unsigned kAllOctants = 0xFF;

struct LightSettings {
  unsigned octants = kAllOctants;  // [1, 255] bit s: light from octant s
  bool geometry_term = true;       // false: the octants' mean visibility, the light variant
};

class VisibilityFieldImpl;

// Visibilities of the octants in a grid.
class OBSCURA_API VisibilityField {
 public:
  VisibilityField();
  ~VisibilityField();
  VisibilityField(VisibilityField&&) noexcept;
  VisibilityField& operator=(VisibilityField&&) noexcept;

  bool empty() const;
  std::array<int, 3> size() const;  // of its own grid, which may be coarser than the volume's
  std::array<float, 3> spacing() const;
  std::array<float, 3> origin() const;  // grid-space position of its first sample
  std::size_t bytes() const;            // of memory held

  // Writes the mean visibility of an octant, in [0, 1], at each sample of the field's own grid.
  Status octant(int octant, GridView<float> visibility) const;
  // The same averaged over all octants: one scalar field without the geometry term.
  Status scalar(GridView<float> visibility, const RunOptions& run = {}) const;

  // Ambient visibility in [0, 1] at points of the surface: the sum of V_s G_s over the chosen
  // octants (equation 4), divided by that of all eight with V = 1, so that an open point is 1 with
  // all. For a field swept with alpha < 1 light comes through the surface too: |N.w| takes the
  // place of max(N.w, 0), and the whole sphere's 2 pi that of pi.
  Status light(std::span<const SurfacePoint> points, const LightSettings& settings,
               std::span<float> visibility, const RunOptions& run = {}) const;

  VisibilityFieldImpl& impl() { return *impl_; }
  const VisibilityFieldImpl& impl() const { return *impl_; }

 private:
  std::unique_ptr<VisibilityFieldImpl> impl_;
};

// Sweeps visibility through the transmittances of a distance field (equations 6 to 8). Needs
// distances only within two voxels of the surface; positive is open. Sweeping into a field of the
// same size again reuses its memory (the field is then empty if memory runs out or the run is
// cancelled).
OBSCURA_API Status sweep_occlusion(GridView<const float> distance,
                                   const OcclusionSettings& settings, VisibilityField* field,
                                   const RunOptions& run = {});

// Soft shadow of one light from any direction: a single octant swept on a grid turned so that its
// axis points to the light (Singh et al. 2011, section 4.1). light() of the result gives V alone,
// without geometry term. `to_light` need not be of unit length.
OBSCURA_API Status sweep_shadow(GridView<const float> distance, std::array<float, 3> to_light,
                                const OcclusionSettings& settings, VisibilityField* field,
                                const RunOptions& run = {});

struct MonteCarloSettings {
  int rays = 1024;
  float start = 0.5f;
  std::uint32_t seed = 1;
};
template <FieldsOf<MonteCarloSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.rays, Field{"rays", "rays per point", closed(1, 1 << 24), "Rays per point."});
  v(s.start,
    Field{"start", "voxels", closed(0, 100), "Distance along the normal at which rays start."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

// Reference: cosine-weighted visibility of surface points by rays traced through the trilinear
// distance field. Rays that leave the volume are open.
OBSCURA_API Status monte_carlo_visibility(GridView<const float> distance,
                                          std::span<const SurfacePoint> points,
                                          const MonteCarloSettings& settings,
                                          std::span<float> visibility, const RunOptions& run = {});

// Reference: 1 where a ray from the point towards `to_light` leaves the volume, else 0.
OBSCURA_API Status hard_shadow(GridView<const float> distance, std::span<const SurfacePoint> points,
                               std::array<float, 3> to_light, const MonteCarloSettings& settings,
                               std::span<float> visibility, const RunOptions& run = {});

}  // namespace obscura

#endif  // OBSCURA_VOLUME_H_
