#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "obscura/patterns.h"
#include "screen/volumetric/patterns/voronoi.h"

namespace obscura {
namespace {

using math::Point;
using math::VoronoiCell;
using math::VoronoiGrid;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point random_direction(bool ball, Random* random) {
  const double z = ball ? 2 * random->uniform() - 1 : 0;
  const double r = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * random->uniform();
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Integration error of weighted samples over half-spaces, which are steps where their border runs
// along the lines: root mean square of the free share of the sphere.
class IntegrationError {
 public:
  explicit IntegrationError(bool ball) : ball_(ball) {
    constexpr int kTests = 768;
    Random random(0x5eed);
    for (int i = 0; i < kTests; ++i) {
      HalfSpace h;
      h.normal = random_direction(i % 3 != 0 || ball, &random);
      h.offset = 2 * random.uniform() - 1;
      // The spherical cap n.p <= c: (2 + 3c - c^3) / 4 of the ball.
      h.share = (2 + 3 * h.offset - h.offset * h.offset * h.offset) / 4;
      tests_.push_back(h);
    }
  }

  double operator()(const std::vector<Point>& points, const std::vector<VoronoiCell>& cells) const {
    double whole = 0, square = 0;
    for (const VoronoiCell& c : cells) whole += c.constant;
    for (const HalfSpace& h : tests_) {
      double free = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        free +=
            cells[i].constant * (ball_ ? dot(h.normal, points[i]) <= h.offset : line(h, points[i]));
      }
      const double error = free / whole - h.share;
      square += error * error;
    }
    return std::sqrt(square / static_cast<double>(tests_.size()));
  }

 private:
  struct HalfSpace {
    Point normal;
    double offset, share;
  };

  // Share of the line at (x, y) through the sphere that lies in the half-space.
  static double line(const HalfSpace& h, const Point& p) {
    const double zs = std::sqrt(std::max(1e-12, 1 - dot(p, p)));
    const double rest = h.offset - dot(h.normal, p), nz = h.normal[2];
    if (std::abs(nz) < 1e-9) return rest >= 0 ? 1 : 0;
    const double z = std::clamp(rest / nz, -zs, zs);
    return (nz > 0 ? z + zs : zs - z) / (2 * zs);
  }

  const bool ball_;
  std::vector<HalfSpace> tests_;
};

// Points that keep their distance if they can: dart throwing with a distance that shrinks.
std::vector<Point> poisson_start(bool ball, const PatternSettings& s, Random* random) {
  std::vector<Point> points;
  if (s.center && !ball) points.push_back({0, 0, 0});
  double distance = 1;
  while (static_cast<int>(points.size()) < s.count) {
    Point p;
    do {
      for (int a = 0; a < 3; ++a) p[a] = ball || a < 2 ? 2 * random->uniform() - 1 : 0;
    } while (dot(p, p) >= 0.95);
    const bool free = std::all_of(points.begin(), points.end(), [&](const Point& q) {
      const Point d = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
      return dot(d, d) > distance * distance;
    });
    if (free) points.push_back(p);
    distance *= 0.995;
  }
  return points;
}

class Relaxation {
 public:
  Relaxation(bool ball, const PatternSettings& settings)
      : ball_(ball),
        fixed_(settings.center && !ball ? 1 : 0),
        coarse_(ball, ball ? 32 : 128),
        fine_(ball, ball ? 128 : 512) {
    const int count = ball ? 200 : 96;
    for (int i = 0; i < count; ++i) {
      // Evenly on the circle; a Fibonacci spiral on the sphere.
      const double angle =
          2 * std::numbers::pi * (ball ? i * std::numbers::phi : double(i) / count);
      const double z = ball ? 1 - (2 * i + 1.0) / count : 0, r = std::sqrt(1 - z * z);
      boundary_.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  }

  // Lets the points move for `steps` steps; the cells of the result on the fine grid.
  std::vector<VoronoiCell> run(int steps, std::vector<Point>* points) const {
    settle(coarse_, steps, points);
    settle(fine_, std::max(1, steps / 50), points);
    return fine_.cells(*points);
  }
  std::vector<VoronoiCell> cells(const std::vector<Point>& points) const {
    return fine_.cells(points);
  }

 private:
  // What a good set has none of: unequal cells, and points off their cells' centroids.
  double error(const std::vector<Point>& points, const std::vector<VoronoiCell>& cells) const {
    double sum = 0;
    for (const VoronoiCell& c : cells) sum += c.constant;
    const double mean = sum / static_cast<double>(cells.size());
    double square = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double unequal = cells[i].constant / mean - 1;
      square += unequal * unequal;
      if (i < fixed_) continue;
      double distance = 0;
      for (int a = 0; a < 3; ++a) {
        const double d = cells[i].centroid[a] - points[i][a];
        distance += d * d;
      }
      square += distance / (spacing(points.size()) * spacing(points.size()));
    }
    return square / static_cast<double>(points.size());
  }
  double spacing(std::size_t count) const {
    return std::pow(static_cast<double>(count), ball_ ? -1.0 / 3 : -0.5);
  }

  std::vector<Point> forces(const std::vector<Point>& points, double charge) const {
    std::vector<Point> force(points.size(), Point{});
    auto repel = [&](std::size_t i, const Point& from, double strength) {
      const Point d = {points[i][0] - from[0], points[i][1] - from[1], points[i][2] - from[2]};
      const double square = std::max(dot(d, d), 1e-6);
      const double scale = strength / (square * square * std::sqrt(square));  // d / |d|^5
      for (int a = 0; a < 3; ++a) force[i][a] += scale * d[a];
    };
    for (std::size_t i = fixed_; i < points.size(); ++i) {
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (j != i) repel(i, points[j], 1);
      }
      for (const Point& b : boundary_) repel(i, b, charge / static_cast<double>(boundary_.size()));
    }
    return force;
  }

  void settle(const VoronoiGrid& grid, int steps, std::vector<Point>* points) const {
    std::vector<VoronoiCell> cells = grid.cells(*points);
    double best = error(*points, cells);
    double charge = static_cast<double>(points->size()), step = 0.2 * spacing(points->size());
    for (int s = 0; s < steps; ++s) {
      // The charge grows while points lie farther out than their centroids, and shrinks otherwise.
      double outward = 0;
      for (std::size_t i = fixed_; i < points->size(); ++i) {
        const Point& p = (*points)[i];
        outward += dot(p, p) - dot(p, cells[i].centroid);
      }
      charge *= outward > 0 ? 1.1 : 1 / 1.1;
      // Where forces and centroids disagree, half of each: forces spread points over the disk,
      // centroids equalise what they stand for.
      const std::vector<Point> force = forces(*points, charge);
      double largest = 1e-12;
      for (const Point& f : force) largest = std::max(largest, std::sqrt(dot(f, f)));
      std::vector<Point> moved = *points;
      for (std::size_t i = fixed_; i < moved.size(); ++i) {
        for (int a = 0; a < 3; ++a) {
          const double pull = (cells[i].centroid[a] - moved[i][a]) / spacing(moved.size());
          moved[i][a] += step * (s % 2 ? force[i][a] / largest : pull);
        }
        const double r = std::sqrt(dot(moved[i], moved[i]));
        if (r > 0.98) {
          for (double& v : moved[i]) v *= 0.98 / r;
        }
      }
      std::vector<VoronoiCell> moved_cells = grid.cells(moved);
      const double moved_error = error(moved, moved_cells);
      if (moved_error < best) {
        best = moved_error;
        *points = std::move(moved);
        cells = std::move(moved_cells);
        step *= 1.3;
      } else {
        step *= 0.8;
      }
    }
  }

  const bool ball_;
  const std::size_t fixed_;
  const VoronoiGrid coarse_, fine_;
  std::vector<Point> boundary_;
};

template <class Sample>
Sample to_sample(const Point& p, const VoronoiCell& c);
template <>
DiskSample to_sample(const Point& p, const VoronoiCell& c) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(c.constant),
          static_cast<float>(c.quadratic)};
}
template <>
BallSample to_sample(const Point& p, const VoronoiCell& c) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]),
          static_cast<float>(c.constant), static_cast<float>(c.quadratic)};
}

template <class Sample>
Status make(bool ball, const PatternSettings& settings, std::vector<Sample>* pattern) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  const Relaxation relaxation(ball, settings);
  const IntegrationError integration_error(ball);
  Random random(settings.seed);
  double best = 1e9;
  for (int start = 0; start < settings.starts; ++start) {
    std::vector<Point> points = poisson_start(ball, settings, &random);
    if (settings.count == 1) points = {Point{}};
    const std::vector<VoronoiCell> cells = relaxation.run(settings.steps, &points);
    const double error = integration_error(points, cells);
    if (error >= best) continue;
    best = error;
    pattern->clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      pattern->push_back(to_sample<Sample>(points[i], cells[i]));
    }
  }
  return {};
}

}  // namespace

Status make_disk_pattern(const PatternSettings& settings, std::vector<DiskSample>* pattern) {
  return make(false, settings, pattern);
}

Status make_ball_pattern(const PatternSettings& settings, std::vector<BallSample>* pattern) {
  return make(true, settings, pattern);
}

void weigh(std::span<DiskSample> samples) {
  std::vector<Point> points;
  for (const DiskSample& s : samples) points.push_back({s.x, s.y, 0});
  const std::vector<VoronoiCell> cells = VoronoiGrid(false, 512).cells(points);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = to_sample<DiskSample>(points[i], cells[i]);
}

void weigh(std::span<BallSample> samples) {
  std::vector<Point> points;
  for (const BallSample& s : samples) points.push_back({s.x, s.y, s.z});
  const std::vector<VoronoiCell> cells = VoronoiGrid(true, 128).cells(points);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = to_sample<BallSample>(points[i], cells[i]);
}

}  // namespace obscura
