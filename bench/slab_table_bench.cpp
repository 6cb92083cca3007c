// Few-point quadrature in registers against tables, on the slices of a real image.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bench/bench_input.h"
#include "bench/slab_table.h"
#include "core/random.h"

namespace obscura::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kReceivers = 256, kSlices = 32, kPoints = 24;

struct Point {
  double v[3];
};
double dot(const Point& a, const Point& b) {
  return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

Point point_at(const tools::DepthInput& in, int x, int y) {
  const double depth = in.depth[static_cast<std::size_t>(y) * in.width + x];
  return {{(x + 0.5 - in.camera.center_u) * in.camera.scale_x * depth,
           (in.camera.center_v - y - 0.5) * in.camera.scale_y * depth, -depth}};
}

// Slices of random receivers in equally many directions, with samples ever farther out, as many
// as the far field reads.
SliceSet slices_of(const tools::DepthInput& in) {
  SliceSet set;
  set.count = kReceivers * kSlices;
  set.points = kPoints;
  set.x.assign(static_cast<std::size_t>(set.count) * kPoints, -1.0f);
  set.y = set.x;
  Random random(5);
  for (int r = 0; r < kReceivers; ++r) {
    const int x = random.below(in.width), y = random.below(in.height);
    const std::size_t at = static_cast<std::size_t>(y) * in.width + x;
    const Point p = point_at(in, x, y), n{{in.normal_x[at], in.normal_y[at], in.normal_z[at]}};
    const double length = std::sqrt(dot(p, p));
    const Point zenith{{-p.v[0] / length, -p.v[1] / length, -p.v[2] / length}};
    for (int k = 0; k < kSlices; ++k) {
      const int slice = r * kSlices + k;
      const double du = std::cos(2 * kPi * k / kSlices), dv = std::sin(2 * kPi * k / kSlices);
      Point tangent{{du, -dv, 0}};
      const double along = dot(tangent, zenith);
      for (int i = 0; i < 3; ++i) tangent.v[i] -= along * zenith.v[i];
      const double scale = 1 / std::sqrt(dot(tangent, tangent));
      for (double& t : tangent.v) t *= scale;
      set.nz.push_back(static_cast<float>(dot(n, zenith)));
      set.nt.push_back(static_cast<float>(dot(n, tangent)));
      set.camera.push_back(static_cast<float>(length));
      double distance = 1;
      for (int i = 0; i < kPoints; ++i, distance += std::max(1.0, 0.3 * distance)) {
        const int hx = static_cast<int>(std::floor(x + 0.5 + distance * du));
        const int hy = static_cast<int>(std::floor(y + 0.5 + distance * dv));
        if (hx < 0 || hy < 0 || hx >= in.width || hy >= in.height) break;
        Point h = point_at(in, hx, hy);
        if (!std::isfinite(h.v[2])) continue;
        for (int j = 0; j < 3; ++j) h.v[j] -= p.v[j];
        const std::size_t to = static_cast<std::size_t>(i) * set.count + slice;
        set.x[to] = static_cast<float>(std::abs(dot(h, tangent)));
        set.y[to] = static_cast<float>(dot(h, zenith));
      }
    }
  }
  return set;
}

// The same integral by many midpoints per piece.
double direct(const math::Rho& rho, const SliceSet& set, int slice) {
  constexpr int kSteps = 100;
  double sum = 0, smallest = kPi;
  const double nz = set.nz[slice], nt = set.nt[slice];
  for (int i = 0; i < set.points; ++i) {
    const std::size_t at = static_cast<std::size_t>(i) * set.count + slice;
    const double x = set.x[at], y = set.y[at], angle = std::atan2(x, y);
    const bool visible = x >= 0 && angle < smallest;
    if (visible) {
      const double ex = x, ey = y - set.camera[slice];
      const double step = (smallest - angle) / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        const double t = angle + step * (k + 0.5), s = std::sin(t), c = std::cos(t);
        const double lobe = std::max(0.0, nz * c + nt * s) * s;
        const double distance = std::min(std::abs((x * ey - y * ex) / (s * ey - c * ex)), 1e30);
        sum += step * lobe * math::evaluate(rho, static_cast<float>(distance));
      }
      smallest = angle;
    }
  }
  return sum;
}

// Mean difference of visibility, %.
double error_of(const std::vector<float>& found, const std::vector<double>& truth) {
  double mean = 0;
  for (int r = 0; r < kReceivers; ++r) {
    double sum = 0;
    for (int k = 0; k < kSlices; ++k) sum += found[r * kSlices + k] - truth[r * kSlices + k];
    mean += std::abs(sum) * 2 / kSlices / kReceivers;
  }
  return 100 * mean;
}

// size: of the tables, 0: quadrature.
void slab_integral(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const tools::DepthInput input = bench_input(640, 360);
  math::Rho rho;
  if (input.depth.empty() || !math::make_rho({.radius = 2.7f}, &rho).ok()) {
    return state.SkipWithError("no input");
  }
  const SliceSet set = slices_of(input);
  std::optional<SlabTable> table;
  if (size > 0) table.emplace(rho, size);
  std::vector<float> out(set.count);
  std::vector<double> truth(set.count);
  for (int i = 0; i < set.count; ++i) truth[i] = direct(rho, set, i);
  evaluate_slices(rho, table ? &*table : nullptr, set, out.data());
  state.counters["e_A_%"] = error_of(out, truth);
  if (!(error_of(out, truth) < 3)) return state.SkipWithError("the result is wrong");
  for (auto _ : state) {
    evaluate_slices(rho, table ? &*table : nullptr, set, out.data());
    benchmark::DoNotOptimize(out.data());
  }
  const auto points = std::count_if(set.x.begin(), set.x.end(), [](float x) { return x >= 0; });
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(points),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(slab_integral)
    ->ArgName("table")
    ->Arg(0)
    ->Arg(16)
    ->Arg(32)
    ->Arg(64)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obscura::bench
