#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <vector>

#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/grid_sampler.h"
#include "volume/sweep_halves.h"
#include "volume/visibility_field.h"

namespace obscura {
// A turned grid of cubes has at most so many voxels for each of the volume's, and some more for
// small volumes: flat or long voxels fall into many cubes.
constexpr double kMostTurned = 64, kFewVoxels = 1 << 24;

Status unit_light(std::array<float, 3>* to_light) {
  std::array<float, 3>& l = *to_light;
  const float length = std::hypot(l[0], l[1], l[2]);
  if (!(length > 0 && std::isfinite(length))) {
    return invalid_argument(
        text("to_light is (", l[0], ", ", l[1], ", ", l[2], "); it must be finite and not zero"));
  }
  for (float& w : l) w /= length;
  return {};
}

Status set_shadow_grid(const std::array<int, 3>& size, const Vec3& spacing, const Vec3& light,
                       const OcclusionSettings& settings, VisibilityFieldImpl* field) {
  VisibilityFieldImpl& f = *field;
  const float fine = *std::min_element(spacing.begin(), spacing.end());
  f.scheme = transport_scheme(settings.transport, {fine, fine, fine});
  f.scheme.plane = false;
  f.alpha = settings.alpha;
  f.shadow = true;
  const float side = fine * static_cast<float>(f.scheme.cell);
  f.spacing = {side, side, side};

  // The rotation about d x l that takes d = (1, 1, 1) / sqrt 3 to the light l, by Rodrigues.
  const float third = 1 / std::numbers::sqrt3_v<float>;
  const Vec3 d{third, third, third};
  const Vec3 v{d[1] * light[2] - d[2] * light[1], d[2] * light[0] - d[0] * light[2],
               d[0] * light[1] - d[1] * light[0]};
  const float c = d[0] * light[0] + d[1] * light[1] + d[2] * light[2];
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (c < -0.9999f) {  // opposite: half a turn about an axis across d
        static constexpr float kAcross[3] = {0.70710678f, -0.70710678f, 0};
        f.turned[a][b] = 2 * kAcross[a] * kAcross[b] - (a == b);
        continue;
      }
      const float cross[3][3] = {{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
      float square = 0;
      for (int k = 0; k < 3; ++k) square += cross[b][k] * cross[k][a];
      f.turned[a][b] = (a == b) + cross[b][a] + square / (1 + c);
    }
  }
  Vec3 low{}, high{};
  for (int corner = 0; corner < 8; ++corner) {
    for (int a = 0; a < 3; ++a) {
      float u = 0;
      for (int b = 0; b < 3; ++b) {
        const float extent = spacing[b] * static_cast<float>(size[b] - 1);
        u += f.turned[a][b] * (corner >> b & 1 ? extent : 0);
      }
      low[a] = std::min(low[a], u);
      high[a] = std::max(high[a], u);
    }
  }
  double turned_voxels = 1, voxels = 1;
  for (int a = 0; a < 3; ++a) {
    turned_voxels *= std::ceil((double{high[a]} - low[a]) / side) + 1;
    voxels *= size[a];
  }
  if (!(turned_voxels <= kMostTurned * voxels + kFewVoxels)) {
    const Vec3& h = spacing;
    return unsupported(text("shadow: with a spacing of ", h[0], ", ", h[1], ", ", h[2],
                            " a grid turned to the light has ", turned_voxels / voxels,
                            " times as many voxels as the volume; at most ", kMostTurned,
                            " are taken: resample it to spacings that are more alike"));
  }
  f.origin = low;
  for (int a = 0; a < 3; ++a) {
    f.size[a] = static_cast<int>(std::ceil((high[a] - low[a]) / side)) + 1;
    f.end[a] = high[a];
  }
  return {};
}

void shadow_tau(const GridSampler& sample, const VisibilityFieldImpl& f, int begin,
                Executor& executor, std::uint8_t* tau) {
  executor.parallel_for(f.size[2], [&](int k, int) {
    const int z = begin + k;
    std::uint8_t* out = tau + static_cast<std::size_t>(k) * f.size[0] * f.size[1];
    for (int y = 0; y < f.size[1]; ++y) {
      for (int x = 0; x < f.size[0]; ++x, ++out) {
        const float q[3] = {f.origin[0] + f.spacing[0] * static_cast<float>(x),
                            f.origin[1] + f.spacing[0] * static_cast<float>(y),
                            f.origin[2] + f.spacing[0] * static_cast<float>(z)};
        Vec3 p{};
        for (int b = 0; b < 3; ++b) {
          for (int a = 0; a < 3; ++a) p[b] += f.turned[a][b] * q[a];
        }
        if (!sample.has(p)) continue;
        const float t =
            sample.inside(p) ? std::clamp(sample(p) / f.spacing[0] + 0.5f, 0.0f, 1.0f) : 1.0f;
        *out = static_cast<std::uint8_t>(255 * (1 - (1 - t) * f.alpha) + 0.5f);
      }
    }
  });
}

namespace {

Status sweep_turned(GridView<const float> distance, const Vec3& light,
                    const OcclusionSettings& settings, VisibilityField* field,
                    const RunOptions& run) {
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  VisibilityField result;
  VisibilityFieldImpl& f = result.impl();
  if (Status s = set_shadow_grid(distance.size, distance.spacing, light, settings, &f); !s.ok()) {
    return s;
  }
  std::vector<std::uint8_t> tau(f.voxels());
  shadow_tau(GridSampler(distance), f, 0, executor, tau.data());
  const int half = static_cast<int>(kShadowOctant >> 2);
  Progress progress(settings.precision == VisibilityPrecision::kU8
                        ? f.size[2]
                        : static_cast<std::int64_t>(f.channels()),
                    run.progress);
  sweep_halves(tau.data(), settings, 1 << half, executor, progress, &f);
  if (progress.cancelled()) return sweep_cancelled();
  *field = std::move(result);
  return {};
}

}  // namespace

Status sweep_shadow(GridView<const float> distance, std::array<float, 3> to_light,
                    const OcclusionSettings& settings, VisibilityField* field,
                    const RunOptions& run) {
  if (Status s = check_sweep(distance, settings); !s.ok()) return s;
  if (Status s = unit_light(&to_light); !s.ok()) return s;
  try {
    return sweep_turned(distance, to_light, settings, field, run);
  } catch (const std::bad_alloc&) {
    return sweep_out_of_memory();
  }
}

}  // namespace obscura
