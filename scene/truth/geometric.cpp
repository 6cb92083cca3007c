#include "scene/truth/geometric.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "obscura/cone.h"
#include "scene/truth/fill_between.h"
#include "scene/truth/point_rays.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kHalfPi = std::numbers::pi / 2;

// Result of one set of directions for a pixel.
struct Estimate {
  double visibility = 0;  // mean V
  double error = 0;       // its standard error
  Vec3 direction;         // mean V w, eye space
};

class Tracer {
 public:
  Tracer(const Rendering& rendering, const GeometricSettings& settings)
      : eye_(rendering.view.eye),
        frame_(rendering.view.frame()),
        g_(rendering.gbuffer),
        s_(settings),
        rays_(*rendering.scene, settings.falloff, settings.rays),
        offset_(settings.offset > 0 ? settings.offset : 1e-5 * g_.scene_size),
        chosen_(settings.offset > 0) {}

  // At least a few steps of the floats in which Embree holds coordinates and images hold depths.
  double offset(Vec3 surface, double depth) const {
    const double largest =
        std::max({std::abs(surface.x), std::abs(surface.y), std::abs(surface.z), depth});
    return chosen_ ? offset_ : std::max(offset_, 4 * 0x1p-24 * largest);
  }

  Vec3 normal(std::size_t i) const { return {g_.normal_x[i], g_.normal_y[i], g_.normal_z[i]}; }

  // x, y in the whole image; `values` holds V of each ray.
  Estimate estimate(int x, int y, bool cosine, std::vector<float>* values) const {
    const std::size_t i = std::size_t(y) * g_.width + x;
    const Camera& c = g_.camera;
    const double depth = g_.depth[i], away = c.orthographic ? 1 : depth;
    const Vec3 point{(x + 0.5 - c.center_u) * c.scale_x * away,
                     (c.center_v - (y + 0.5)) * c.scale_y * away, -depth};
    const Frame around = Frame::around(normal(i));
    const Frame world{frame_.to_world(around.x), frame_.to_world(around.y),
                      frame_.to_world(around.z)};
    const Vec3 surface = eye_ + frame_.to_world(point);
    const Vec3 origin = surface + world.z * offset(surface, depth);
    const std::uint64_t key = (std::uint64_t(s_.seed) << 33) ^ (std::uint64_t(i) << 1);
    const PointRays::Result r = rays_.trace(origin, world, cosine, key, values);
    return {r.visibility, r.error, around.to_world(r.sum) / rays_.count()};
  }

 private:
  const Vec3 eye_;
  const Frame frame_;
  const DepthInput& g_;
  const GeometricSettings& s_;
  const PointRays rays_;
  const double offset_;
  const bool chosen_;  // by the user
};

void set(const ImageView<float>& view, int x, int y, double value) {
  if (!view.empty()) view(x, y) = float(value);
}
void set(const VectorView<float>& view, int x, int y, Vec3 value) {
  if (view.empty()) return;
  view.x(x, y) = float(value.x);
  view.y(x, y) = float(value.y);
  view.z(x, y) = float(value.z);
}

void set_all(const Outputs& o, int x, int y, double visibility, Vec3 direction, double angle,
             double uniform, double cosine, double error) {
  set(o.visibility, x, y, visibility);
  set(o.bent_normal, x, y, direction);
  set(o.cone_angle, x, y, angle);
  set(o.uniform_integral, x, y, direction * uniform);
  set(o.cosine_integral, x, y, direction * cosine);
  set(o.standard_error, x, y, error);
}

Status check(const Rendering& rendering, const GeometricSettings& settings,
             const Outputs& outputs) {
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  const ViewSpec& view = rendering.view;
  const DepthInput& g = rendering.gbuffer;
  if (!rendering.scene || g.depth.empty() || g.normal_x.empty() || g.width != view.full_width() ||
      g.height != view.full_height()) {
    return invalid_input("geometric needs a rendered scene or mesh with depth and normals");
  }
  Status status;
  auto of_visible_size = [&](const ImageView<float>& v, const char* name) {
    if (v.empty() || !status.ok() || (v.width == view.width && v.height == view.height)) return;
    status = invalid_argument(fmt::format("output {} is {}x{}; it must be {}x{}, the visible size",
                                          name, v.width, v.height, view.width, view.height));
  };
  auto vectors = [&](const VectorView<float>& v, const char* name) {
    if (v.empty()) return;
    for (const auto* channel : {&v.x, &v.y, &v.z}) {
      if (channel->empty() && status.ok()) {
        status = invalid_argument(fmt::format("output {} lacks a channel", name));
      }
      of_visible_size(*channel, name);
    }
  };
  of_visible_size(outputs.visibility, "visibility");
  vectors(outputs.bent_normal, "bent-normal");
  of_visible_size(outputs.cone_angle, "cone-angle");
  vectors(outputs.uniform_integral, "uniform-integral");
  vectors(outputs.cosine_integral, "cosine-integral");
  of_visible_size(outputs.standard_error, "standard-error");
  return status;
}

}  // namespace

Status trace_geometric(const Rendering& rendering, const GeometricSettings& settings,
                       const Outputs& outputs, const RunOptions& options) {
  if (Status s = check(rendering, settings, outputs); !s.ok()) return s;
  std::unique_ptr<Executor> own;
  if (!options.executor) own = make_executor(options.threads);
  Executor& executor = options.executor ? *options.executor : *own;

  const bool uniform_visibility = settings.weighting == RayWeighting::kUniform;
  const bool wants_visibility = !outputs.visibility.empty() || !outputs.standard_error.empty();
  const bool cosine = (wants_visibility && !uniform_visibility) || !outputs.cosine_integral.empty();
  const bool uniform = (wants_visibility && uniform_visibility) || !outputs.bent_normal.empty() ||
                       !outputs.cone_angle.empty() || !outputs.uniform_integral.empty();
  const Tracer tracer(rendering, settings);
  const DepthInput& g = rendering.gbuffer;
  const int width = rendering.view.width, height = rendering.view.height;
  std::vector<std::vector<float>> values(executor.thread_count(),
                                         std::vector<float>(settings.rays));
  auto pixel = [&](int x, int y, int worker) {
    const int full_x = x + g.guard_band.left, full_y = y + g.guard_band.top;
    const std::size_t i = std::size_t(full_y) * g.width + full_x;
    if (g.depth[i] == kInf) return set_all(outputs, x, y, 1, {0, 0, 1}, kHalfPi, 1, 2.0 / 3, 0);
    if (x % settings.every != settings.every / 2 || y % settings.every != settings.every / 2) {
      return set_all(outputs, x, y, kNaN, {kNaN, kNaN, kNaN}, kNaN, 1, 1, kNaN);
    }
    Estimate by_cosine, by_area;
    if (cosine) by_cosine = tracer.estimate(full_x, full_y, true, &values[worker]);
    if (uniform) by_area = tracer.estimate(full_x, full_y, false, &values[worker]);
    const Estimate& e = uniform_visibility ? by_area : by_cosine;
    set(outputs.visibility, x, y, e.visibility);
    set(outputs.standard_error, x, y, e.error);
    set(outputs.cosine_integral, x, y, by_cosine.direction);
    // Equation 2: 1/pi of the integral, 2 pi times the mean.
    set(outputs.uniform_integral, x, y, by_area.direction * 2);
    const double open = length(by_area.direction);
    set(outputs.bent_normal, x, y, open > 0 ? by_area.direction / open : tracer.normal(i));
    const double mean = by_area.visibility > 0 ? open / by_area.visibility : 1;
    set(outputs.cone_angle, x, y, cone_angle(ConeEstimate::kExact, static_cast<float>(mean)));
  };

  constexpr int kSpan = 16;  // pixels of a task
  const int spans = (width + kSpan - 1) / kSpan, tasks = spans * height;
  std::atomic<int> done = 0;
  std::atomic<bool> cancelled = false;
  std::mutex telling;
  executor.parallel_for(tasks, [&](int task, int worker) {
    if (cancelled) return;
    const int y = task / spans, x0 = task % spans * kSpan;
    for (int x = x0; x < std::min(width, x0 + kSpan); ++x) pixel(x, y, worker);
    const int finished = ++done;
    if (options.progress && telling.try_lock()) {
      if (!cancelled && !options.progress(double(finished) / tasks)) cancelled = true;
      telling.unlock();
    }
  });
  if (cancelled) return {StatusCode::kCancelled, "geometric was cancelled"};
  if (settings.interpolate && settings.every > 1) {
    fill_between(g, settings.every, outputs, executor);
  }
  return {};
}

}  // namespace obscura::tools
