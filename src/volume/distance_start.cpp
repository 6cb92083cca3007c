#include "volume/distance_start.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "volume/distance_kernel.h"

namespace obscura {
namespace {

constexpr int kSlab = 16;           // planes of a task
constexpr float kMaxValue = 1e18f;  // its square is a float

bool is_open(float f) { return f > 0; }

// The function whose zero is the surface, positive in the open, for one plane of voxels, and
// whether it is positive.
class OpenField {
 public:
  OpenField(const VolumeView& volume, const DistanceSettings& settings)
      : volume_(volume),
        sign_(settings.solid == SolidSide::kAbove ? -1.0f : 1.0f),
        isovalue_(settings.isovalue) {}

  void plane(int z, float* out, std::uint8_t* open) const {
    const int width = volume_.size[0];
    for (int y = 0; y < volume_.size[1]; ++y, out += width, open += width) {
      volume_row(volume_, y, z, out);
      for (int x = 0; x < width; ++x) {
        const float f = sign_ * (out[x] - isovalue_);
        // Written so that NaN becomes open.
        const float capped = f < kMaxValue ? f : kMaxValue;
        out[x] = capped > -kMaxValue ? capped : -kMaxValue;
      }
      for (int x = 0; x < width; ++x) open[x] = is_open(out[x]);
    }
  }

 private:
  const VolumeView& volume_;
  float sign_, isovalue_;
};

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

// One plane of voxels with those before and after it, and which voxels of a row are near.
struct Planes {
  Planes(std::size_t width, std::size_t voxels) : near(width) {
    for (int i = 0; i < 3; ++i) {
      values[i].resize(voxels);
      open[i].resize(voxels);
    }
  }
  void advance() {
    std::rotate(values, values + 1, values + 3);
    std::rotate(open, open + 1, open + 3);
  }
  std::vector<float> values[3];
  std::vector<std::uint8_t> open[3];
  std::vector<std::uint8_t> near;
};

// Marks the voxels of a row that have a neighbour on the other side of the surface; returns whether
// there is any. A null neighbouring row is outside the grid.
bool mark_near(const std::uint8_t* open, const std::uint8_t* const beside[4], int width,
               std::uint8_t* near) {
  std::fill_n(near, width, std::uint8_t{0});
  auto mark = [&](const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* to, int count) {
    for (int x = 0; x < count; ++x) to[x] = static_cast<std::uint8_t>(to[x] | (a[x] ^ b[x]));
  };
  for (int i = 0; i < 4; ++i) {
    if (beside[i]) mark(open, beside[i], near, width);
  }
  mark(open, open + 1, near, width - 1);
  mark(open, open + 1, near + 1, width - 1);
  unsigned any = 0;
  for (int x = 0; x < width; ++x) any |= near[x];
  return any != 0;
}

}  // namespace

void start_distance(const VolumeView& volume, int first, const DistanceSettings& settings,
                    GridView<float> distance, Executor& executor) {
  const int nx = volume.size[0], ny = volume.size[1], nz = volume.size[2];
  const std::ptrdiff_t row = nx;
  const auto stride = distance.strides();
  const OpenField field(volume, settings);
  // Made before anything is written: nothing allocates within the loop.
  std::vector<Planes> scratch;
  scratch.reserve(static_cast<std::size_t>(executor.thread_count()));
  for (int i = 0; i < executor.thread_count(); ++i) {
    scratch.emplace_back(static_cast<std::size_t>(nx), static_cast<std::size_t>(row * ny));
  }
  const int planes_out = distance.size[2];
  executor.parallel_for((planes_out + kSlab - 1) / kSlab, [&](int slab, int worker) {
    const int begin = first + slab * kSlab;
    const int end = std::min(first + planes_out, begin + kSlab);
    Planes& planes = scratch[static_cast<std::size_t>(worker)];
    auto load = [&](int z, int place) {
      if (z < 0 || z >= nz) return;
      field.plane(z, planes.values[place].data(), planes.open[place].data());
    };
    load(begin - 1, 0);
    load(begin, 1);
    for (int z = begin; z < end; ++z) {
      load(z + 1, 2);
      const bool below = z > 0, above = z + 1 < nz;
      for (int y = 0; y < ny; ++y) {
        const std::ptrdiff_t at = y * row;
        const std::uint8_t* open = planes.open[1].data() + at;
        const std::uint8_t* const beside[] = {y > 0 ? open - row : nullptr,
                                              y + 1 < ny ? open + row : nullptr,
                                              below ? planes.open[0].data() + at : nullptr,
                                              above ? planes.open[2].data() + at : nullptr};
        float* out = distance.data + (z - first) * stride[2] + y * stride[1];
        for (int x = 0; x < nx; ++x) {
          out[x * stride[0]] = open[x] ? kUnknownDistance : -kUnknownDistance;
        }
        if (!mark_near(open, beside, nx, planes.near.data())) continue;
        const float* f = planes.values[1].data() + at;
        const float* low = planes.values[0].data() + at;
        const float* high = planes.values[2].data() + at;
        for (int x = 0; x < nx; ++x) {
          if (!planes.near[static_cast<std::size_t>(x)]) continue;
          Beside voxel(f[x]);
          voxel.axis(x > 0 ? f + x - 1 : nullptr, x + 1 < nx ? f + x + 1 : nullptr,
                     volume.spacing[0]);
          voxel.axis(y > 0 ? f + x - row : nullptr, y + 1 < ny ? f + x + row : nullptr,
                     volume.spacing[1]);
          voxel.axis(below ? low + x : nullptr, above ? high + x : nullptr, volume.spacing[2]);
          const float d = settings.start == DistanceStart::kEdges ? voxel.edge() : voxel.gradient();
          out[x * stride[0]] = open[x] ? d : -d;
        }
      }
      planes.advance();
    }
  });
}

}  // namespace obscura
