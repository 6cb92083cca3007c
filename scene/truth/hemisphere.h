#ifndef OBSCURA_SCENE_TRUTH_HEMISPHERE_H_
#define OBSCURA_SCENE_TRUTH_HEMISPHERE_H_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace obscura::tools {

// The hemisphere cut into `count` strata of equal weight: rings of equal share, each cut into
// equal sectors.
class Hemisphere {
 public:
  struct Direction {
    float x, y, z;  // unit, z >= 0 along the normal
  };

  explicit Hemisphere(int count) {
    const int rings = std::max(1, int(std::lround(std::sqrt(double(count)))));
    for (int ring = 0; ring < rings; ++ring) {
      rings_.push_back(int(std::int64_t(ring) * count / rings));
      const auto first = int(std::int64_t(ring) * count / rings);
      const auto end = int(std::int64_t(ring + 1) * count / rings);
      for (int i = first; i < end; ++i) {
        strata_.push_back({float(double(first) / count), float(double(end - first) / count),
                           float(2 * std::numbers::pi * (i - first) / (end - first)),
                           float(2 * std::numbers::pi / (end - first))});
      }
    }
    rings_.push_back(count);
  }

  int count() const { return int(strata_.size()); }

  // The direction at (u, v) in [0, 1)^2 of a stratum.
  Direction cosine_weighted(int stratum, float u, float v) const {
    const float square = share(stratum, u), radius = std::sqrt(square);
    return on_ring(stratum, v, radius, std::sqrt(std::max(0.0f, 1 - square)));
  }
  Direction uniform(int stratum, float u, float v) const {
    const float z = 1 - share(stratum, u);
    return on_ring(stratum, v, std::sqrt(std::max(0.0f, 1 - z * z)), z);
  }

  // Standard error of the mean of one value per stratum. The variance of a stratum is estimated
  // from the second difference with its neighbours on the ring. So a steady change around the ring,
  // which stratification integrates well, does not count as noise.
  double standard_error(const std::vector<float>& v) const {
    const int n = count();
    double sum = 0;
    if (n < 9) {  // rings of fewer than three
      double mean = 0;
      for (float value : v) mean += value / n;
      for (float value : v) sum += (value - mean) * (value - mean);
      return n == 1 ? std::sqrt(mean * (1 - mean)) : std::sqrt(sum / (n - 1) / n);
    }
    for (std::size_t ring = 0; ring + 1 < rings_.size(); ++ring) {
      const int first = rings_[ring], end = rings_[ring + 1];
      double before = v[end - 1], here = v[first];
      for (int i = first; i < end; ++i) {
        const double after = v[i + 1 < end ? i + 1 : first];
        const double second = before - 2 * here + after;
        sum += second * second / 6;
        before = here;
        here = after;
      }
    }
    return std::sqrt(sum) / n;
  }

 private:
  struct Stratum {
    float share, width, angle, sector;
  };

  float share(int i, float u) const { return strata_[i].share + u * strata_[i].width; }
  Direction on_ring(int i, float v, float radius, float z) const {
    const float angle = strata_[i].angle + v * strata_[i].sector;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

  std::vector<Stratum> strata_;
  std::vector<int> rings_;  // where each ring begins, and the end
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_HEMISPHERE_H_
