#include "obscura/importance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/check_sphere.h"
#include "core/guarded.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "filters/bilateral/bilateral.h"
#include "view/geometry.h"

namespace obscura {
namespace {

constexpr double kPi = std::numbers::pi;

struct Vec {
  float x, y, z;
};
float dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// One direction, eye space, and L / (pi p) there.
struct LightSample {
  Vec w;
  std::array<float, 3> light;
};

// Light by direction as cells of equal height in cos theta and width in azimuth.
class LightTable {
 public:
  static constexpr int kRows = 64, kColumns = 128;
  static constexpr double kCell = 4 * kPi / (kRows * kColumns);  // solid angle

  explicit LightTable(const Environment& environment) : environment_(environment) {
    double sum = 0;
    for (int i = 0; i < kRows * kColumns; ++i) {
      cumulative_.push_back(sum);
      sum += luminance(environment.radiance(direction(i, 0.5, 0.5))) * kCell;
    }
    // Every cell gets some directions, also those whose centre saw no light.
    const double floor = 0.05 * sum / (kRows * kColumns);
    for (int i = 0; i < kRows * kColumns; ++i) cumulative_[i] += i * floor;
    cumulative_.push_back(1.05 * sum);
    if (!(sum > 0)) {
      for (std::size_t i = 0; i < cumulative_.size(); ++i) cumulative_[i] = static_cast<double>(i);
    }
    map_power_ = sum;
    sun_power_ = environment.sun().shines() ? luminance(environment.sun().irradiance) : 0;
  }

  // `pick` in [0, 1) chooses the cell or the sun, a and b in [0, 1) the place in it.
  void sample(double pick, double a, double b, std::array<double, 3>* w,
              std::array<float, 3>* light) const {
    const double of_sun =
        sun_power_ > 0 ? sun_power_ / (sun_power_ + std::max(map_power_, 1e-30)) : 0;
    if (pick < of_sun) {
      sample_sun(a, b, w);
      for (int k = 0; k < 3; ++k) {
        (*light)[k] = static_cast<float>(environment_.sun().irradiance[k] / (kPi * of_sun));
      }
      return;
    }
    const double at = (pick - of_sun) / (1 - of_sun) * cumulative_.back();
    const auto next = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, at);
    const int cell = std::max(static_cast<int>(next - cumulative_.begin()) - 1, 0);
    const double density = (cumulative_[cell + 1] - cumulative_[cell]) / cumulative_.back() / kCell;
    const std::array<float, 3> d = direction(cell, a, b);
    const std::array<float, 3> radiance = environment_.radiance(d);
    for (int k = 0; k < 3; ++k) {
      (*w)[k] = d[k];
      (*light)[k] = static_cast<float>(radiance[k] / (kPi * density * (1 - of_sun)));
    }
  }

 private:
  static double luminance(const std::array<float, 3>& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  }
  static std::array<float, 3> direction(int cell, double a, double b) {
    const int row = cell / kColumns;
    const double y = 1 - 2 * (row + a) / kRows;
    const double s = std::sqrt(std::max(1 - y * y, 0.0));
    const double phi = 2 * kPi * (cell % kColumns + b) / kColumns;
    return {float(s * std::sin(phi)), float(y), float(-s * std::cos(phi))};
  }
  void sample_sun(double a, double b, std::array<double, 3>* w) const {
    const Sun& sun = environment_.sun();
    const double cosine = 1 - a * (1 - std::cos(sun.angular_radius));
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)), phi = 2 * kPi * b;
    const double z[3] = {sun.direction[0], sun.direction[1], sun.direction[2]};
    const double u[3] = {std::abs(z[0]) < 0.5 ? 1.0 : 0.0, std::abs(z[0]) < 0.5 ? 0.0 : 1.0, 0};
    double x[3] = {z[1] * u[2] - z[2] * u[1], z[2] * u[0] - z[0] * u[2], z[0] * u[1] - z[1] * u[0]};
    const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (double& c : x) c /= length;
    const double y[3] = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2],
                         z[0] * x[1] - z[1] * x[0]};
    for (int k = 0; k < 3; ++k) {
      (*w)[k] = cosine * z[k] + sine * (std::cos(phi) * x[k] + std::sin(phi) * y[k]);
    }
  }

  const Environment& environment_;
  std::vector<double> cumulative_;
  double map_power_ = 0, sun_power_ = 0;
};

double radical_inverse(int i, int base) {
  double result = 0, scale = 1.0 / base;
  for (; i > 0; i /= base, scale /= base) result += i % base * scale;
  return result;
}

// samples x m x m directions; those of one pixel are stored together. Sample s of a pixel lies in
// stratum s of the light's power.
std::vector<LightSample> make_samples(const Environment& environment,
                                      const ImportanceSettings& settings) {
  const LightTable table(environment);
  const int cells = settings.interleave * settings.interleave;
  Random random(settings.seed);
  std::vector<int> order(cells);
  for (int i = 0; i < cells; ++i) order[i] = i;
  for (int i = cells - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  const double turn_a = random.uniform(), turn_b = random.uniform();
  std::vector<LightSample> samples(static_cast<std::size_t>(cells) * settings.samples);
  const std::array<float, 9>& m = settings.world_from_eye;
  for (int cell = 0; cell < cells; ++cell) {
    for (int s = 0; s < settings.samples; ++s) {
      // The pixel's rank differs from stratum to stratum.
      const int rank = (order[cell] + 7 * s) % cells, i = s * cells + rank;
      const double pick = (s + (rank + 0.5) / cells) / settings.samples;
      const double a = radical_inverse(i + 1, 2) + turn_a, b = radical_inverse(i + 1, 3) + turn_b;
      LightSample& sample = samples[static_cast<std::size_t>(cell) * settings.samples + s];
      std::array<double, 3> w;
      table.sample(pick, a - std::floor(a), b - std::floor(b), &w, &sample.light);
      auto eye = [&](int k) {
        return static_cast<float>(m[k] * w[0] + m[3 + k] * w[1] + m[6 + k] * w[2]);
      };
      sample.w = {eye(0), eye(1), eye(2)};
    }
  }
  return samples;
}

// Tests points along rays from one receiver.
class Marcher {
 public:
  Marcher(const view::Geometry& g, const ImportanceSettings& s) : g_(g), s_(s) {}

  Vec ray(float x, float y) const {  // of the texel's centre, at depth 1
    const Camera& c = g_.camera;
    return {(x + 0.5f - c.center_u) * c.scale_x, (c.center_v - y - 0.5f) * c.scale_y, -1};
  }
  Vec surface(int x, int y) const {
    const float depth = g_.depth(x, y), away = g_.camera.orthographic ? 1.0f : depth;
    const Vec r = ray(static_cast<float>(x), static_cast<float>(y));
    return {r.x * away, r.y * away, -depth};
  }

  // V of direction w from p; `offset` in [0, 1) of a step.
  float visibility(const Vec& p, const Vec& n, const Vec& w, float offset) const {
    const Camera& c = g_.camera;
    const float cosine = dot(n, w), slack = -p.z * 1e-5f;
    for (int k = 0; k < s_.steps; ++k) {
      const float share = (static_cast<float>(k) + offset) / static_cast<float>(s_.steps);
      const float t = share * share * s_.falloff.radius;
      const float z = -(p.z + t * w.z);
      if (!(z > 0)) break;
      const float scale = c.orthographic ? 1.0f : 1 / z;
      const float u = (p.x + t * w.x) * scale / c.scale_x + c.center_u;
      const float v = c.center_v - (p.y + t * w.y) * scale / c.scale_y;
      if (!(u >= 0 && v >= 0 && u < static_cast<float>(g_.width) &&
            v < static_cast<float>(g_.height))) {
        break;
      }
      const int x = static_cast<int>(u), y = static_cast<int>(v);
      if (!std::isfinite(g_.depth(x, y)) || !in_matter(p, n, x, y, z, t * cosine + slack)) continue;
      if (s_.falloff.kind != FalloffKind::kQuadratic) return 0;
      const float near = 1 - t / s_.falloff.radius;
      return 1 - near * near;
    }
    return 1;
  }

 private:
  // The tested point, moved to its texel's view ray parallel to the tangent plane, so that planes
  // of any tilt are open.
  bool in_matter(const Vec& p, const Vec& n, int x, int y, float z, float height) const {
    const Vec q = surface(x, y), r = ray(static_cast<float>(x), static_cast<float>(y));
    const Vec along = g_.camera.orthographic ? Vec{0, 0, -1} : r;
    const float rise = dot(n, {q.x - p.x, q.y - p.y, q.z - p.z});
    if (!(dot(n, along) < 0 ? rise > height : -q.z < z)) return false;
    if (s_.occluder.kind == OccluderKind::kSolid) return true;
    const float length = g_.camera.orthographic ? 1.0f : std::sqrt(dot(r, r));
    return z < -q.z + s_.occluder.thickness / length;
  }

  const view::Geometry& g_;
  const ImportanceSettings& s_;
};

Status check(const DepthField& field, const Environment& environment,
             const ImportanceSettings& settings, const VectorView<float>& out) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_sphere(settings.falloff, settings.occluder, "importance sampling"); !s.ok())
    return s;
  if (environment.empty()) return invalid_argument("environment is empty");
  for (const auto* view : {&out.x, &out.y, &out.z}) {
    if (view->width == field.visible().width && view->height == field.visible().height) continue;
    return invalid_argument(text("out is ", view->width, "x", view->height, "; it must be ",
                                 field.visible().width, "x", field.visible().height,
                                 ", the visible size"));
  }
  return {};
}

}  // namespace

Status light_by_importance(const DepthField& field, const Environment& environment,
                           const ImportanceSettings& settings, const VectorView<float>& out,
                           const RunOptions& options) {
  return guarded("lighting by importance", [&]() -> Status {
    if (Status s = check(field, environment, settings, out); !s.ok()) return s;
    const RunThreads threads(options);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    view::Geometry g;
    if (Status s = view::convert(field, {.normals = true}, executor, &g); !s.ok()) return s;
    const std::vector<LightSample> samples = make_samples(environment, settings);
    const Marcher marcher(g, settings);
    const int width = g.visible().width, height = g.visible().height, m = settings.interleave;
    BilateralFilter filter;  // before anything is written to the outputs: it allocates
    if (settings.blur) {
      filter.resize(width, height);
      filter.set_size(width, height);
    }
    Progress progress(height, options.progress);
    executor.parallel_for(height, [&](int row, int) {
      if (progress.cancelled()) return;
      for (int column = 0; column < width; ++column) {
        const int x = column + g.guard_band.left, y = row + g.guard_band.top;
        float sum[3] = {};
        const int cell = row % m * m + column % m;
        if (std::isfinite(g.depth(x, y))) {
          const Vec p = marcher.surface(x, y),
                    n{g.normal_x(x, y), g.normal_y(x, y), g.normal_z(x, y)};
          for (int s = 0; s < settings.samples; ++s) {
            const LightSample& sample =
                samples[static_cast<std::size_t>(cell) * settings.samples + s];
            const float cosine = dot(n, sample.w);
            if (!(cosine > 0)) continue;
            // Offsets differ between the pattern's pixels and between samples; none is 0.
            const double spread = (cell + 0.5) / (m * m) + s * std::numbers::phi;
            const float offset = static_cast<float>(spread - std::floor(spread));
            const float lit = cosine * marcher.visibility(p, n, sample.w, offset);
            for (int k = 0; k < 3; ++k) sum[k] += lit * sample.light[k];
          }
        }
        const float scale = 1 / static_cast<float>(settings.samples);
        out.x(column, row) = sum[0] * scale;
        out.y(column, row) = sum[1] * scale;
        out.z(column, row) = sum[2] * scale;
      }
      progress.advance();
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    if (!settings.blur) return {};
    for (const auto* view : {&out.x, &out.y, &out.z}) {
      const ImageView<float> input = filter.input();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) input(x, y) = (*view)(x, y);
      }
      filter.run(g, settings.falloff.radius, executor, *view);
    }
    return {};
  });
}

}  // namespace obscura
