#include "io/patterns/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura::tools {
namespace {

constexpr int kTests = 2000;
constexpr double kPi = std::numbers::pi;

// The k-th number of the R-sequence in `dimensions` dimensions (Roberts 2018).
double r_sequence(int k, int axis, int dimensions, double start) {
  double g = 2;  // the root of g^(d+1) = g + 1
  for (int i = 0; i < 60; ++i) g = std::pow(1 + g, 1.0 / (dimensions + 1));
  return std::fmod(start + (k + 1) * std::pow(1 / g, axis + 1), 1.0);
}

struct Test {
  double x, y, z;        // half-space: its normal; step: the direction across the edge in x, y
  double offset, depth;  // step: where the edge is, and the depth of what lies beyond it
  double share;          // of the sphere that is free
};

std::vector<Test> half_spaces() {
  std::vector<Test> tests;
  for (int i = 0; i < kTests; ++i) {
    const double z = 2 * r_sequence(i, 0, 3, 0.37) - 1, r = std::sqrt(1 - z * z);
    const double turn = 2 * kPi * r_sequence(i, 1, 3, 0.11);
    const double c = 2 * r_sequence(i, 2, 3, 0.73) - 1;
    tests.push_back({r * std::cos(turn), r * std::sin(turn), z, c, 0, (2 + 3 * c - c * c * c) / 4});
  }
  return tests;
}

// Share of the unit ball with x > c and z > d: its slices at x are segments of circles.
double quarter_share(double c, double d) {
  auto segment = [d](double x) {
    const double r = std::sqrt(std::max(0.0, 1 - x * x));
    if (d >= r) return 0.0;
    if (d <= -r) return kPi * r * r;
    return r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
  };
  constexpr int kSlices = 400;
  double sum = 0;
  for (int i = 0; i < kSlices; ++i) sum += segment(c + (1 - c) * (i + 0.5) / kSlices);
  return sum * (1 - c) / kSlices / (4 * kPi / 3);
}

std::vector<Test> steps() {
  std::vector<Test> tests;
  for (int i = 0; i < kTests; ++i) {
    const double turn = 2 * kPi * r_sequence(i, 0, 3, 0.21);
    const double c = 2 * r_sequence(i, 1, 3, 0.57) - 1, d = 2 * r_sequence(i, 2, 3, 0.91) - 1;
    tests.push_back({std::cos(turn), std::sin(turn), 0, c, d, 1 - quarter_share(c, d)});
  }
  return tests;
}

// Root mean square of estimate - share, in per cent. `free` gives a sample's free share.
template <class Sample, class Free>
double rms(std::span<const Sample> samples, const std::vector<Test>& tests, Free free) {
  double whole = 0, square = 0;
  for (const Sample& s : samples) whole += s.weight_constant;
  for (const Test& t : tests) {
    double sum = 0;
    for (const Sample& s : samples) sum += s.weight_constant * free(s, t);
    const double error = sum / whole - t.share;
    square += error * error;
  }
  return 100 * std::sqrt(square / static_cast<double>(tests.size()));
}

double radical_inverse(int i, int base) {
  double result = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) result += digit * (i % base);
  return result;
}

std::uint64_t next(std::uint64_t* state) {
  std::uint64_t z = *state += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}
double uniform(std::uint64_t* state) { return static_cast<double>(next(state) >> 11) * 0x1p-53; }

struct Unit {
  double u[3];
};

// Points of the unit square or cube.
std::vector<Unit> unit_points(RivalPattern rival, int count, int dimensions, std::uint64_t* state) {
  std::vector<Unit> points(count);
  if (rival == RivalPattern::kStratified) {
    // A grid with at least `count` strata, as even as can be; as many of them, at random.
    int n[3] = {1, 1, 1};
    for (int a = 0; n[0] * n[1] * n[2] < count; a = (a + 1) % dimensions) ++n[a];
    std::vector<int> strata(n[0] * n[1] * n[2]);
    for (std::size_t i = 0; i < strata.size(); ++i) strata[i] = static_cast<int>(i);
    for (std::size_t i = strata.size() - 1; i > 0; --i) {
      std::swap(strata[i], strata[next(state) % (i + 1)]);
    }
    for (int i = 0; i < count; ++i) {
      const int at[3] = {strata[i] % n[0], strata[i] / n[0] % n[1], strata[i] / (n[0] * n[1])};
      for (int a = 0; a < dimensions; ++a) points[i].u[a] = (at[a] + uniform(state)) / n[a];
    }
    return points;
  }
  for (int i = 0; i < count; ++i) {
    for (int a = 0; a < dimensions; ++a) {
      if (rival == RivalPattern::kR2) {
        points[i].u[a] = r_sequence(i, a, dimensions, 0.5);
      } else {
        points[i].u[a] = a == 0 ? (i + 0.5) / count : radical_inverse(i, a + 1);
      }
    }
  }
  return points;
}

// Darts in the square or cube around the ball, with a distance that shrinks until all fit.
std::vector<Unit> darts(int count, int dimensions, std::uint64_t* state) {
  std::vector<Unit> points;
  double distance = 2;
  while (static_cast<int>(points.size()) < count) {
    Unit p{};
    double square = 0;
    for (int a = 0; a < dimensions; ++a) {
      p.u[a] = 2 * uniform(state) - 1;
      square += p.u[a] * p.u[a];
    }
    if (square >= 0.999) continue;
    bool far = true;
    for (const Unit& q : points) {
      double d = 0;
      for (int a = 0; a < dimensions; ++a) d += (p.u[a] - q.u[a]) * (p.u[a] - q.u[a]);
      far = far && d > distance * distance;
    }
    if (far) points.push_back(p);
    distance *= 0.999;
  }
  return points;
}

}  // namespace

double PatternQuality::both() const {
  return std::sqrt((half_spaces * half_spaces + steps * steps) / 2);
}

PatternQuality quality(std::span<const DiskSample> lines) {
  static const std::vector<Test> planes = half_spaces(), edges = steps();
  auto extent = [](const DiskSample& s) {
    return std::sqrt(std::max(1e-12, 1.0 - double(s.x) * s.x - double(s.y) * s.y));
  };
  PatternQuality q;
  q.half_spaces = rms(lines, planes, [&](const DiskSample& s, const Test& t) {
    const double zs = extent(s), z = std::clamp((t.offset - t.x * s.x - t.y * s.y) / t.z, -zs, zs);
    return (t.z > 0 ? zs + z : zs - z) / (2 * zs);
  });
  q.steps = rms(lines, edges, [&](const DiskSample& s, const Test& t) {
    const double zs = extent(s);
    if (t.x * s.x + t.y * s.y <= t.offset) return 1.0;
    return (std::clamp(t.depth, -zs, zs) + zs) / (2 * zs);
  });
  return q;
}

PatternQuality quality(std::span<const BallSample> points) {
  static const std::vector<Test> planes = half_spaces(), edges = steps();
  PatternQuality q;
  q.half_spaces = rms(points, planes, [](const BallSample& s, const Test& t) {
    return t.x * s.x + t.y * s.y + t.z * s.z <= t.offset ? 1.0 : 0.0;
  });
  q.steps = rms(points, edges, [](const BallSample& s, const Test& t) {
    return t.x * s.x + t.y * s.y <= t.offset || s.z <= t.depth ? 1.0 : 0.0;
  });
  return q;
}

std::vector<DiskSample> rival_disk(RivalPattern rival, int count, bool by_density,
                                   std::uint32_t seed) {
  std::uint64_t state = seed;
  std::vector<DiskSample> samples;
  if (rival == RivalPattern::kPoisson) {
    for (const Unit& p : darts(count, 2, &state)) {
      samples.push_back({static_cast<float>(p.u[0]), static_cast<float>(p.u[1]), 0, 0});
    }
  } else {
    for (const Unit& p : unit_points(rival, count, 2, &state)) {
      // The extent's share within r is 1 - (1 - r^2)^(3/2).
      const double r =
          by_density ? std::sqrt(1 - std::pow(1 - p.u[0], 2.0 / 3)) : std::sqrt(p.u[0]);
      const double turn = 2 * kPi * p.u[1];
      samples.push_back(
          {static_cast<float>(r * std::cos(turn)), static_cast<float>(r * std::sin(turn)), 0, 0});
    }
  }
  weigh(samples);
  return samples;
}

std::vector<BallSample> rival_ball(RivalPattern rival, int count, std::uint32_t seed) {
  std::uint64_t state = seed;
  std::vector<BallSample> samples;
  auto add = [&](double x, double y, double z) {
    samples.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0, 0});
  };
  if (rival == RivalPattern::kPoisson) {
    for (const Unit& p : darts(count, 3, &state)) add(p.u[0], p.u[1], p.u[2]);
  } else {
    for (const Unit& p : unit_points(rival, count, 3, &state)) {
      const double r = std::cbrt(p.u[0]), z = 2 * p.u[1] - 1, turn = 2 * kPi * p.u[2];
      const double lateral = r * std::sqrt(1 - z * z);
      add(lateral * std::cos(turn), lateral * std::sin(turn), r * z);
    }
  }
  weigh(samples);
  return samples;
}

}  // namespace obscura::tools
