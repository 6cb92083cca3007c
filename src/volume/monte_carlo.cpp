#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/grid_sampler.h"
#include "volume/volume_access.h"

namespace obscura {
namespace {

constexpr int kBlock = 256;  // points of a task

// Sphere tracing: |D| is how far a ray may go without meeting the surface. Swept distances are up
// to a few per cent too long; near the surface the least step is a fraction of a voxel.
class Tracer {
 public:
  explicit Tracer(const GridView<const float>& distance)
      : sample_(distance),
        least_step_(0.3f * *std::min_element(distance.spacing.begin(), distance.spacing.end())) {}

  bool open(Vec3 p, const Vec3& w) const {
    while (sample_.inside(p)) {
      const float d = sample_(p);
      if (d < 0) return false;
      const float step = std::max(0.8f * d, least_step_);
      for (int a = 0; a < 3; ++a) p[a] += step * w[a];
    }
    return true;
  }

 private:
  GridSampler sample_;
  float least_step_;
};

std::uint32_t mix(std::uint32_t v) {
  v = (v ^ (v >> 16)) * 0x7FEB352Du;
  v = (v ^ (v >> 15)) * 0x846CA68Bu;
  return v ^ (v >> 16);
}
float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

std::uint32_t reversed_bits(std::uint32_t v) {
  v = (v >> 16) | (v << 16);
  v = ((v & 0xFF00FF00u) >> 8) | ((v & 0x00FF00FFu) << 8);
  v = ((v & 0xF0F0F0F0u) >> 4) | ((v & 0x0F0F0F0Fu) << 4);
  v = ((v & 0xCCCCCCCCu) >> 2) | ((v & 0x33333333u) << 2);
  return ((v & 0xAAAAAAAAu) >> 1) | ((v & 0x55555555u) << 1);
}

// Share of cosine-weighted rays that stay open: a Hammersley set, shifted at random per point.
float visibility_at(const Tracer& tracer, const Vec3& p, const Vec3& n, int rays,
                    std::uint32_t key) {
  // A basis around the normal without a branch near its poles (Duff et al. 2017).
  const float s = std::copysign(1.0f, n[2]), a = -1 / (s + n[2]), b = n[0] * n[1] * a;
  const Vec3 t{1 + s * n[0] * n[0] * a, s * b, -s * n[0]}, u{b, s + n[1] * n[1] * a, -n[1]};
  const std::uint32_t shift_u = mix(key), shift_v = mix(key ^ 0x9E3779B9u);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const auto even =
        static_cast<std::uint32_t>((std::uint64_t{index} << 32) / static_cast<std::uint64_t>(rays));
    const float radius2 = unit(even + shift_u);
    const float turn = 2 * std::numbers::pi_v<float> * unit(reversed_bits(index) + shift_v);
    const float radius = std::sqrt(radius2), up = std::sqrt(1 - radius2);
    const float x = radius * std::cos(turn), y = radius * std::sin(turn);
    const Vec3 w{x * t[0] + y * u[0] + up * n[0], x * t[1] + y * u[1] + up * n[1],
                 x * t[2] + y * u[2] + up * n[2]};
    open += tracer.open(p, w);
  }
  return static_cast<float>(open) / static_cast<float>(rays);
}

Status check(const GridView<const float>& distance, std::span<const SurfacePoint> points,
             const MonteCarloSettings& settings, std::span<float> visibility) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate_grid("distance", distance.data, distance.size, distance.spacing);
      !s.ok()) {
    return s;
  }
  if (visibility.size() != points.size()) {
    return invalid_input(text("visibility holds ", visibility.size(), " values; it must hold ",
                              points.size(), ", one per point"));
  }
  return {};
}

// Calls value(start, point, index) for every point, where `start` lies off the surface.
template <class F>
Status for_points(const GridView<const float>& distance, std::span<const SurfacePoint> points,
                  const MonteCarloSettings& settings, std::span<float> visibility,
                  const RunOptions& run, const F& value) {
  return guarded("the rays of a volume", [&]() -> Status {
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    const std::size_t blocks = (points.size() + kBlock - 1) / kBlock;
    Progress progress(static_cast<std::int64_t>(blocks), run.progress);
    executor.parallel_for(static_cast<int>(blocks), [&](int block, int) {
      if (progress.cancelled()) return;
      const std::size_t begin = static_cast<std::size_t>(block) * kBlock;
      const std::size_t end = std::min(points.size(), begin + kBlock);
      for (std::size_t i = begin; i < end; ++i) {
        const SurfacePoint& point = points[i];
        Vec3 p = point.position;
        for (int a = 0; a < 3; ++a) p[a] += settings.start * distance.spacing[a] * point.normal[a];
        visibility[i] = value(p, point, static_cast<std::uint32_t>(i));
      }
      progress.advance();
    });
    if (progress.cancelled()) {
      return {StatusCode::kCancelled, "the Monte Carlo run was cancelled by the caller"};
    }
    return {};
  });
}

}  // namespace

Status monte_carlo_visibility(GridView<const float> distance, std::span<const SurfacePoint> points,
                              const MonteCarloSettings& settings, std::span<float> visibility,
                              const RunOptions& run) {
  if (Status s = check(distance, points, settings, visibility); !s.ok()) return s;
  const Tracer tracer(distance);
  return for_points(distance, points, settings, visibility, run,
                    [&](const Vec3& p, const SurfacePoint& point, std::uint32_t index) {
                      return visibility_at(tracer, p, point.normal, settings.rays,
                                           mix(index) ^ settings.seed);
                    });
}

Status hard_shadow(GridView<const float> distance, std::span<const SurfacePoint> points,
                   std::array<float, 3> to_light, const MonteCarloSettings& settings,
                   std::span<float> visibility, const RunOptions& run) {
  if (Status s = check(distance, points, settings, visibility); !s.ok()) return s;
  const float length = std::hypot(to_light[0], to_light[1], to_light[2]);
  if (!(length > 0 && std::isfinite(length))) {
    return invalid_argument(text("to_light is (", to_light[0], ", ", to_light[1], ", ", to_light[2],
                                 "); it must be finite and not zero"));
  }
  for (float& w : to_light) w /= length;
  const Tracer tracer(distance);
  return for_points(distance, points, settings, visibility, run,
                    [&](const Vec3& p, const SurfacePoint& point, std::uint32_t) {
                      const Vec3& n = point.normal;
                      const float facing =
                          n[0] * to_light[0] + n[1] * to_light[1] + n[2] * to_light[2];
                      return facing > 0 && tracer.open(p, to_light) ? 1.0f : 0.0f;
                    });
}

}  // namespace obscura
