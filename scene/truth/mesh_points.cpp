#include "scene/truth/mesh_points.h"

#include <fmt/format.h>

#include <atomic>
#include <mutex>

#include "scene/truth/point_rays.h"

namespace obscura::tools {
namespace {

Vec3 at(std::span<const float> values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

Status check(const MeshPoints& points, const MeshPointSettings& settings,
             const MeshPointOutputs& outputs) {
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  const std::size_t count = points.positions.size() / 3;
  if (points.normals.size() != points.positions.size()) {
    return invalid_argument(fmt::format("there are {} points and {} normals; each has one", count,
                                        points.normals.size() / 3));
  }
  if ((!outputs.visibility.empty() && outputs.visibility.size() != count) ||
      (!outputs.bent_normal.empty() && outputs.bent_normal.size() != 3 * count)) {
    return invalid_argument("outputs have another size than the points");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 n = at(points.normals, i);
    if (!is_finite(at(points.positions, i))) {
      return invalid_input(fmt::format("point {} is not finite", i));
    }
    if (!is_finite(n) || !(length(n) > 0)) {
      return invalid_input(fmt::format("normal {} is {:g},{:g},{:g}; it must have a length above 0",
                                       i, n.x, n.y, n.z));
    }
  }
  return {};
}

}  // namespace

Status trace_points(const RayScene& scene, const MeshPoints& points,
                    const MeshPointSettings& settings, const MeshPointOutputs& outputs,
                    const RunOptions& options) {
  if (Status s = check(points, settings, outputs); !s.ok()) return s;
  std::unique_ptr<Executor> own;
  if (!options.executor) own = make_executor(options.threads);
  Executor& executor = options.executor ? *options.executor : *own;
  const PointRays rays(scene, settings.falloff, settings.rays);
  const double size = scene.bounds().longest_side();
  std::vector<std::vector<float>> values(executor.thread_count(),
                                         std::vector<float>(settings.rays));
  auto point = [&](std::size_t i, int worker) {
    const Vec3 surface = at(points.positions, i);
    const Frame around = Frame::around(normalize(at(points.normals, i)));
    // At least a few steps of the floats in which Embree holds coordinates.
    const double largest =
        std::max({std::abs(surface.x), std::abs(surface.y), std::abs(surface.z)});
    const double lift =
        settings.offset > 0 ? settings.offset : std::max(1e-5 * size, 4 * 0x1p-24 * largest);
    const Vec3 origin = surface + around.z * lift;
    const std::uint64_t key = (std::uint64_t(settings.seed) << 33) ^ (std::uint64_t(i) << 1);
    if (!outputs.visibility.empty()) {
      outputs.visibility[i] =
          float(rays.trace(origin, around, true, key, &values[worker]).visibility);
    }
    if (outputs.bent_normal.empty()) return;
    const Vec3 sum = rays.trace(origin, around, false, key, &values[worker]).sum;
    const Vec3 bent = length(sum) > 0 ? around.to_world(sum) / length(sum) : around.z;
    outputs.bent_normal[3 * i] = float(bent.x);
    outputs.bent_normal[3 * i + 1] = float(bent.y);
    outputs.bent_normal[3 * i + 2] = float(bent.z);
  };

  constexpr std::size_t kSpan = 64;  // points of a task
  const std::size_t count = points.positions.size() / 3;
  const int tasks = int((count + kSpan - 1) / kSpan);
  std::atomic<int> done = 0;
  std::atomic<bool> cancelled = false;
  std::mutex telling;
  executor.parallel_for(tasks, [&](int task, int worker) {
    if (cancelled) return;
    const std::size_t first = task * kSpan, end = std::min(count, first + kSpan);
    for (std::size_t i = first; i < end; ++i) point(i, worker);
    const int finished = ++done;
    if (options.progress && telling.try_lock()) {
      if (!cancelled && !options.progress(double(finished) / tasks)) cancelled = true;
      telling.unlock();
    }
  });
  if (cancelled) return {StatusCode::kCancelled, "the points were cancelled"};
  return {};
}

}  // namespace obscura::tools
