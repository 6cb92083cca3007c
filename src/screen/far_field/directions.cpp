#include "screen/far_field/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/leaf_scalar.h"

namespace obscura {
namespace leaf_scalar {
#include "screen/far_field/share_leaf.h"
}  // namespace leaf_scalar

namespace far_field {
namespace {

constexpr double kPi = std::numbers::pi;

// The adaptive samples: one close by, so that no chord starts at the receiver itself, then where
// the slice crosses rows of texels and, near by, columns, for the surface bends there and nowhere
// else.
constexpr double kFirstSample = 0.125;  // pixels
constexpr double kColumnsWithin = 16;   // pixels; what a sample subtends shrinks with distance
constexpr double kLeastBetweenSamples = 0.1;  // pixels

constexpr int kJitterCells = 9;

// Rounded so that samples on lattice lines stay on them, mirrored ones too.
double to_lattice(double x) { return std::round(x * 4096) / 4096; }

NearTap tap_at(double u, double v) {
  const int du = static_cast<int>(std::floor(u)), dv = static_cast<int>(std::floor(v));
  return {float(v), du, dv, float(u - du), float(v - dv)};
}

// Of a slice whose column changes by `slope` per row, and that goes on for `end` rows; a pixel of
// it is `rows` rows long.
std::vector<NearTap> taps_on_crossings(double slope, double rows, double end) {
  struct Point {
    double u, v;
  };
  std::vector<Point> crossings;
  for (int v = 1; v < end; ++v) crossings.push_back({to_lattice(v * slope), double(v)});
  for (int column = 1;; ++column) {
    const double v = to_lattice(column / std::max(std::abs(slope), 1e-9));
    if (v > std::min(kColumnsWithin * rows, end)) break;
    crossings.push_back({std::copysign(column, slope), v});
  }
  std::sort(crossings.begin(), crossings.end(), [](Point a, Point b) { return a.v < b.v; });
  const double first = to_lattice(kFirstSample * rows);
  std::vector<NearTap> taps = {tap_at(to_lattice(first * slope), first)};
  double last = 0;
  for (const Point& p : crossings) {
    if (p.v - last < kLeastBetweenSamples * rows) continue;
    taps.push_back(tap_at(p.u, p.v));
    last = p.v;
  }
  return taps;
}

std::vector<NearTap> make_taps(const FarFieldSettings& s, double angle) {
  std::vector<NearTap> taps;
  if (!s.near_field) return taps;
  const double rows = std::cos(angle), slope = std::tan(angle);
  if (s.occluder.kind != OccluderKind::kSolid) {
    // Matter that ends is met texel by texel, where the slice crosses rows.
    for (int v = 1; v <= longest_near_field(s.interval); ++v) {
      taps.push_back(tap_at(to_lattice(v * slope), v));
    }
    return taps;
  }
  const double end = longest_near_field(s.interval), step = s.near_step.px;
  if (step == 0) return taps_on_crossings(slope, rows, end);
  for (int i = 1; i * step < end / rows; ++i) {
    const double v = to_lattice(i * step * rows);
    taps.push_back(tap_at(to_lattice(v * slope), v));
  }
  return taps;
}

Segment make_segment(const FarFieldSettings& s, double low, double width) {
  return {.low = static_cast<float>(std::tan(low)),
          .high = static_cast<float>(std::tan(low + width)),
          .middle = static_cast<float>(std::tan(low + 0.5 * width)),
          .taps = make_taps(s, low + 0.5 * width)};
}

// Strips of one direction are all cut at the same rows; directions that cut elsewhere keep that
// from showing. Left and right directions share their phase, so that mirrored images are treated
// alike.
int strip_offset(bool transposed, int sign, double angle, int interval) {
  const double down = transposed ? std::sin(angle) : sign * std::cos(angle);
  const double golden = down * 1.618033988749895 * 7 + 16;
  return static_cast<int>((golden - std::floor(golden)) * 4 * interval);
}

}  // namespace

int group_side(const FarFieldSettings& s) { return s.jitter ? 3 : s.separable; }

std::vector<Direction> make_directions(const FarFieldSettings& s) {
  // Half a sector of rotation keeps every sector on one side of the diagonals where 8 divides K.
  const double offset = s.directions % 8 == 0 ? 0.5 : 0;
  std::vector<Direction> directions(s.directions);
  for (int k = 0; k < s.directions; ++k) {
    Direction& d = directions[k];
    const double azimuth = 2 * kPi * (k + offset) / s.directions;
    const double u = std::cos(azimuth), v = std::sin(azimuth);
    // On the diagonal itself rounding must not decide.
    d.transposed = std::abs(u) > std::abs(v) + 1e-9;
    d.sign = (d.transposed ? u : v) > 0 ? 1 : -1;
    const double angle = std::atan2(d.transposed ? v : u, std::abs(d.transposed ? u : v));
    d.slope = static_cast<float>(std::tan(angle));
    d.strip_offset = strip_offset(d.transposed, d.sign, angle, s.interval);
    d.share = k % (s.separable * s.separable);
    d.segments.resize(s.jitter ? kJitterCells : 1);
    const double width = 2 * kPi / s.directions / s.segments;
    for (std::size_t cell = 0; cell < d.segments.size(); ++cell) {
      const int c = static_cast<int>(cell), place = leaf_scalar::share_of_cell(c / 3, c % 3, 3);
      const double turn = s.jitter ? width * (place - 0.5 * (kJitterCells - 1)) / kJitterCells : 0;
      for (int i = 0; i < s.segments; ++i) {
        d.segments[cell].push_back(
            make_segment(s, angle + turn + width * (i - 0.5 * s.segments), width));
      }
    }
  }
  return directions;
}

int sideways_reach(const std::vector<Direction>& directions, int interval) {
  double slope = 0;
  for (const Direction& d : directions) {
    slope = std::max<double>(slope, std::abs(d.slope));
    for (const auto& segments : d.segments) {
      for (const Segment& s : segments) slope = std::max<double>(slope, std::abs(s.middle));
    }
  }
  return static_cast<int>(std::ceil(slope * 2 * interval)) + 2;
}

}  // namespace far_field
}  // namespace obscura
