#include <algorithm>
#include <cmath>
#include <memory>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/transport.h"
#include "volume/visibility_field.h"

namespace obscura {
namespace {

constexpr int kMaxChannels = 8 * kMaxDirections;
constexpr int kBlock = 1024;  // points of a task

// Light at one point, from the visibilities of all channels at the position where it is looked up.
float gather(const VisibilityFieldImpl& f, const LightSettings& light, const SurfacePoint& point,
             const Place& place, const float* visibility) {
  const int n = f.directions();
  const Vec3& normal = point.normal;
  if (f.shadow || !light.geometry_term) {
    float sum = 0, count = 0;
    for (int s = f.shadow ? 7 : 0; s < 8; ++s) {
      if (!f.shadow && !(light.octants >> s & 1)) continue;
      const float* v = visibility + f.first_of_all(s);
      const float within = place.within(s);
      for (int i = 0; i < n; ++i) {
        sum += f.scheme.directions[i].weight * (1 + within * (v[i] - 1));
      }
      ++count;
    }
    return std::min(sum / count, 1.0f);
  }
  const bool through = f.alpha < 1;
  float sum = 0, all = 0;
  float plane[PlaneTable::kRoom];
  std::fill_n(plane, PlaneTable::kRoom, 1.0f);
  PlaneTable::Heights heights;
  if (f.scheme.plane) heights = f.heights(place, point);
  for (int s = 0; s < 8; ++s) {
    const bool on = (light.octants >> s & 1) != 0;
    const float* v = visibility + f.first_of_all(s);
    const float within = place.within(s);
    if (n == 1 && !f.scheme.plane) {
      // Equation 4. If light passes through the surface, the geometry term of its other side is
      // added.
      const float g = octant_geometry(normal, s) +
                      (through ? octant_geometry({-normal[0], -normal[1], -normal[2]}, s) : 0.0f);
      if (on) sum += g * (1 + within * (v[0] - 1));
      all += g;
      continue;
    }
    Vec3 reflected = normal;
    for (int a = 0; a < 3; ++a) reflected[a] = s >> a & 1 ? normal[a] : -normal[a];
    if (!through && reflected[0] <= 0 && reflected[1] <= 0 && reflected[2] <= 0) continue;
    if (on && f.scheme.plane) f.plane->look_up(reflected, heights, plane);
    for (int i = 0; i < n; ++i) {
      const SweepDirection& d = f.scheme.directions[i];
      const float cosine = d.direction[0] * reflected[0] + d.direction[1] * reflected[1] +
                           d.direction[2] * reflected[2];
      if (cosine <= 0 && !through) continue;
      const float weight = d.weight * std::fabs(cosine);
      const float open = std::min(1.0f, cosine > 0 ? v[i] / plane[i] : v[i]);
      if (on) sum += weight * (1 + within * (open - 1));
      all += weight;
    }
  }
  return std::min(sum / all, 1.0f);
}

}  // namespace

Status VisibilityField::light(std::span<const SurfacePoint> points, const LightSettings& settings,
                              std::span<float> visibility, const RunOptions& run) const {
  return guarded("the light of surface points", [&]() -> Status {
    if (empty()) return invalid_input("the visibility field is empty; sweep it first");
    if (settings.octants == 0 || settings.octants > kAllOctants) {
      return invalid_argument(text("octants is ", settings.octants, "; it must be in [1, 255]"));
    }
    if (visibility.size() != points.size()) {
      return invalid_input(text("visibility holds ", visibility.size(), " values; it must hold ",
                                points.size(), ", one per point"));
    }
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    const VisibilityFieldImpl& f = *impl_;
    int halves = 0;
    for (int half = 0; half < 2; ++half) {
      const bool wanted = f.shadow || (settings.octants >> (4 * half) & 0xF) != 0;
      halves |= int{f.has_half(half) && wanted} << half;
    }
    const std::size_t blocks = (points.size() + kBlock - 1) / kBlock;
    Progress progress(static_cast<std::int64_t>(blocks), run.progress);
    executor.parallel_for(static_cast<int>(blocks), [&](int block, int) {
      if (progress.cancelled()) return;
      const std::size_t begin = static_cast<std::size_t>(block) * kBlock;
      const std::size_t end = std::min(points.size(), begin + kBlock);
      float values[kMaxChannels];
      for (std::size_t i = begin; i < end; ++i) {
        const SurfacePoint& point = points[i];
        Vec3 p = point.position;
        for (int a = 0; a < 3; ++a) p[a] += f.scheme.lookup * f.spacing[a] * point.normal[a];
        if (f.shadow) {
          const Vec3 q = p;
          for (int a = 0; a < 3; ++a) {
            p[a] = f.turned[a][0] * q[0] + f.turned[a][1] * q[1] + f.turned[a][2] * q[2];
          }
        }
        const Place place = f.place(p);
        f.sample(place, halves, values);
        visibility[i] = gather(f, settings, point, place, values);
      }
      progress.advance();
    });
    if (progress.cancelled()) {
      return {StatusCode::kCancelled, "the look-up of light was cancelled by the caller"};
    }
    return {};
  });
}

}  // namespace obscura
