#include "scene/volumes/volume_framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace obscura::tools {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 vec(const Double3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

MatterOutline::MatterOutline(const VolumeImage& image, GridView<const float> distance,
                             const RunOptions& run)
    : ends_(std::size_t(image.size[1]) * std::size_t(image.size[2])),
      rows_(std::size_t(image.size[1])),
      origin_(vec(image.origin)) {
  for (int a = 0; a < 3; ++a) axes_[a] = vec(image.axes[a]);
  const auto stride = distance.strides();
  const int nx = image.size[0];
  std::unique_ptr<Executor> own;
  if (!run.executor) own = make_executor(run.threads);
  Executor& executor = run.executor ? *run.executor : *own;
  executor.parallel_for(image.size[2], [&](int z, int) {
    for (int y = 0; y < image.size[1]; ++y) {
      const float* row = distance.data + y * stride[1] + z * stride[2];
      int first = 0, last = nx - 1;
      while (first < nx && !(row[first * stride[0]] <= 0)) ++first;
      while (last > first && !(row[last * stride[0]] <= 0)) --last;
      if (first == nx) continue;
      ends_[std::size_t(z) * rows_ + std::size_t(y)] = {std::int16_t(first), std::int16_t(last)};
    }
  });
  if (std::all_of(ends_.begin(), ends_.end(), [](Ends e) { return e.first > e.last; })) {
    std::fill(ends_.begin(), ends_.end(), Ends{0, std::int16_t(nx - 1)});
  }
  // The box along the grid's axes.
  int low[3] = {nx, image.size[1], image.size[2]}, high[3] = {-1, -1, -1};
  for (std::size_t row = 0; row < ends_.size(); ++row) {
    const Ends e = ends_[row];
    if (e.first > e.last) continue;
    const int least[3] = {e.first, int(row % rows_), int(row / rows_)};
    const int most[3] = {e.last, least[1], least[2]};
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], least[a]);
      high[a] = std::max(high[a], most[a]);
    }
  }
  low_ = high_ = origin_;
  for (int a = 0; a < 3; ++a) {
    low_ += double(low[a]) * axes_[a];
    high_ += double(high[a]) * axes_[a];
  }
}

double MatterOutline::margin() const {
  return 0.5 * std::max({length(axes_[0]), length(axes_[1]), length(axes_[2])});
}

namespace {

// Least and greatest of the outline's coordinates along right and up, seen from `middle`, each with
// its coordinate along `forward` times `slope` added or taken away.
struct Extents {
  double least[2] = {kInfinity, kInfinity}, most[2] = {-kInfinity, -kInfinity};

  Extents(const MatterOutline& outline, const ViewAxes& axes, Vec3 middle, const double* slope) {
    double room[2];
    for (int k = 0; k < 2; ++k) room[k] = outline.margin() * std::sqrt(1 + slope[k] * slope[k]);
    outline.for_each([&](Vec3 p) {
      const Vec3 d = p - middle;
      const double lateral[2] = {dot(d, axes.right), dot(d, axes.up)};
      const double w = dot(d, axes.forward);
      for (int k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], lateral[k] + slope[k] * w - room[k]);
        most[k] = std::max(most[k], lateral[k] - slope[k] * w + room[k]);
      }
    });
  }
  // Widens them so that zero is in the middle.
  void centre() {
    for (int k = 0; k < 2; ++k) {
      most[k] = std::max(most[k], -least[k]);
      least[k] = -most[k];
    }
  }
  double middle(int k) const { return 0.5 * (least[k] + most[k]); }
};

}  // namespace

Vec3 fit_perspective(const MatterOutline& outline, const ViewAxes& axes,
                     const std::optional<Vec3>& look_at, double slope, double aspect,
                     double filled) {
  // A point (u, v, w) along right, up and forward is in the picture of a camera at e where
  // |u - e_u| <= s (w - e_w): u + s w bounds e_u + s e_w from above, u - s w bounds e_u - s e_w
  // from below, and so for v.
  const Vec3 middle = look_at.value_or(outline.middle());
  const double s[2] = {slope * aspect * filled, slope * filled};
  Extents e(outline, axes, middle, s);
  if (look_at) e.centre();
  const double back =
      std::min((e.least[0] - e.most[0]) / (2 * s[0]), (e.least[1] - e.most[1]) / (2 * s[1]));
  return middle + e.middle(0) * axes.right + e.middle(1) * axes.up + back * axes.forward;
}

OrthographicFit fit_orthographic(const MatterOutline& outline, const ViewAxes& axes,
                                 const std::optional<Vec3>& look_at, double aspect, double filled) {
  const Vec3 middle = look_at.value_or(outline.middle());
  const double s[2] = {0, 0};
  Extents e(outline, axes, middle, s);
  if (look_at) e.centre();
  const double behind =
      length(middle - outline.middle()) + 2 * (outline.reach() + outline.margin());
  return {middle + e.middle(0) * axes.right + e.middle(1) * axes.up - behind * axes.forward,
          std::max((e.most[0] - e.least[0]) / aspect, e.most[1] - e.least[1]) / filled};
}

}  // namespace obscura::tools
