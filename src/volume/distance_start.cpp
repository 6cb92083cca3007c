#include "volume/distance_start.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "volume/distance_kernel.h"

namespace obscura {
namespace {

constexpr int kSlab = 8;            // planes of a task
constexpr float kMaxValue = 1e18f;  // its square is a float

// The function whose zero is the surface, positive in the open, for one plane of voxels.
class OpenField {
 public:
  OpenField(const VolumeView& volume, const DistanceSettings& settings)
      : volume_(volume),
        sign_(settings.solid == SolidSide::kAbove ? -1.0f : 1.0f),
        isovalue_(settings.isovalue) {}

  void plane(int z, float* out) const {
    const int width = volume_.size[0];
    for (int y = 0; y < volume_.size[1]; ++y, out += width) {
      volume_row(volume_, y, z, out);
      for (int x = 0; x < width; ++x) {
        const float f = sign_ * (out[x] - isovalue_);
        // Written so that NaN becomes open.
        const float capped = f < kMaxValue ? f : kMaxValue;
        out[x] = capped > -kMaxValue ? capped : -kMaxValue;
      }
    }
  }

 private:
  const VolumeView& volume_;
  float sign_, isovalue_;
};

bool is_open(float f) { return f > 0; }

// Distance of a voxel from the surface, from its value and those of its neighbours along one axis
// after the other.
class Beside {
 public:
  Beside(float f) : f_(f), magnitude_(std::fabs(double{f})) {}

  // Null where the grid ends.
  void axis(const float* below, const float* above, double spacing) {
    double crossing = 0, descending = 0;
    for (const float* neighbour : {below, above}) {
      if (!neighbour) continue;
      const double m = std::fabs(double{*neighbour});
      if (is_open(*neighbour) != is_open(f_)) {
        crossing = std::max(crossing, magnitude_ + m);
        edge_ = std::min(edge_, magnitude_ + m > 0 ? spacing * magnitude_ / (magnitude_ + m) : 0);
      } else {
        descending = std::max(descending, magnitude_ - m);
      }
    }
    // One-sided differences towards the surface: across it where it is crossed.
    const double slope = (crossing > 0 ? crossing : descending) / spacing;
    gradient2_ += slope * slope;
  }
  float edge() const { return static_cast<float>(edge_); }
  float gradient() const {
    if (gradient2_ == 0) return edge();
    return static_cast<float>(std::min(edge_, magnitude_ / std::sqrt(gradient2_)));
  }

 private:
  float f_;
  double magnitude_, edge_ = 1e30, gradient2_ = 0;
};

}  // namespace

void start_distance(const VolumeView& volume, const DistanceSettings& settings,
                    GridView<float> distance, Executor& executor, std::int64_t* solid,
                    std::int64_t* open) {
  const int nx = volume.size[0], ny = volume.size[1], nz = volume.size[2];
  const std::ptrdiff_t row = nx, plane = row * ny;
  const auto stride = distance.strides();
  std::atomic<std::int64_t> solid_count{0};
  executor.parallel_for((nz + kSlab - 1) / kSlab, [&](int slab, int) {
    const OpenField field(volume, settings);
    const int begin = slab * kSlab, end = std::min(nz, begin + kSlab);
    std::vector<float> storage(static_cast<std::size_t>(3 * plane));
    float* planes[3];  // z - 1, z, z + 1
    for (int i = 0; i < 3; ++i) planes[i] = storage.data() + i * plane;
    if (begin > 0) field.plane(begin - 1, planes[0]);
    field.plane(begin, planes[1]);
    std::int64_t count = 0;
    std::vector<unsigned char> near(static_cast<std::size_t>(nx));
    for (int z = begin; z < end; ++z) {
      if (z + 1 < nz) field.plane(z + 1, planes[2]);
      for (int y = 0; y < ny; ++y) {
        const float* f = planes[1] + y * row;
        float* out = distance.data + z * stride[2] + y * stride[1];
        const float* beside[] = {y > 0 ? f - row : f, y + 1 < ny ? f + row : f,
                                 z > 0 ? planes[0] + y * row : f,
                                 z + 1 < nz ? planes[2] + y * row : f};
        unsigned any = 0;
        int inside = 0;
        for (int x = 0; x < nx; ++x) {
          unsigned crossed = 0;
          for (const float* b : beside) crossed |= is_open(b[x]) != is_open(f[x]);
          near[x] = static_cast<unsigned char>(crossed);
          any |= crossed;
          inside += !is_open(f[x]);
        }
        for (int x = 0; x + 1 < nx; ++x) {
          const unsigned crossed = is_open(f[x]) != is_open(f[x + 1]);
          near[x] = static_cast<unsigned char>(near[x] | crossed);
          near[x + 1] = static_cast<unsigned char>(near[x + 1] | crossed);
          any |= crossed;
        }
        count += inside;
        for (int x = 0; x < nx; ++x) {
          out[x * stride[0]] = is_open(f[x]) ? kUnknownDistance : -kUnknownDistance;
        }
        if (!any) continue;
        for (int x = 0; x < nx; ++x) {
          if (!near[x]) continue;
          Beside voxel(f[x]);
          voxel.axis(x > 0 ? f + x - 1 : nullptr, x + 1 < nx ? f + x + 1 : nullptr,
                     volume.spacing[0]);
          voxel.axis(y > 0 ? f + x - row : nullptr, y + 1 < ny ? f + x + row : nullptr,
                     volume.spacing[1]);
          voxel.axis(z > 0 ? planes[0] + y * row + x : nullptr,
                     z + 1 < nz ? planes[2] + y * row + x : nullptr, volume.spacing[2]);
          const float d = settings.start == DistanceStart::kEdges ? voxel.edge() : voxel.gradient();
          out[x * stride[0]] = is_open(f[x]) ? d : -d;
        }
      }
      std::rotate(planes, planes + 1, planes + 3);
    }
    solid_count += count;
  });
  *solid = solid_count;
  *open = static_cast<std::int64_t>(plane) * nz - solid_count;
}

}  // namespace obscura
