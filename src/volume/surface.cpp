#include "obscura/surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/surface_kernel.h"
#include "volume/volume_access.h"

namespace obscura {
namespace {

using Vec3 = std::array<float, 3>;
constexpr int kBlockRows = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Status check_camera(const SurfaceCamera& c) {
  for (const float e : c.eye) {
    if (!(std::fabs(e) < 1e18f)) {
      return invalid_argument(text("camera.eye has ", e, "; it must be finite"));
    }
  }
  for (const auto& [a, b] : {std::pair{c.right, c.up}, {c.up, c.forward}, {c.forward, c.right}}) {
    // Written so that NaN fails.
    if (!(std::fabs(dot(a, b)) < 1e-2f && std::fabs(dot(a, a) - 1) < 1e-2f)) {
      return invalid_argument(
          "camera.right, up and forward must be of unit length and at right angles");
    }
  }
  if (c.orthographic && !(c.ortho_height > 0 && c.ortho_height < 1e18f)) {
    return invalid_argument(
        text("camera.ortho_height is ", c.ortho_height, "; it must be positive and finite"));
  }
  if (!c.orthographic && !(c.fov_y > 0 && c.fov_y < 3.1415926f)) {
    return invalid_argument(text("camera.fov_y is ", c.fov_y, "; it must be in (0, pi)"));
  }
  return {};
}

Status check_scene(const SurfaceScene& s) {
  if (Status status = validate(s.volume); !status.ok()) return status;
  if (Status status = validate_grid("distance", s.distance.data, s.distance.size, s.volume.spacing);
      !status.ok()) {
    return status;
  }
  if (s.distance.size != s.volume.size) {
    return invalid_input("distance.size must be the volume's");
  }
  if (!std::isfinite(s.isovalue)) {
    return invalid_argument(text("isovalue is ", s.isovalue, "; it must be finite"));
  }
  return {};
}

Status check_outputs(const SurfaceOutputs& o, int* width, int* height) {
  *width = *height = 0;
  for (const ImageView<float>* image : {&o.visibility, &o.coverage, &o.depth}) {
    if (image->empty()) continue;
    if (*width == 0) {
      *width = image->width;
      *height = image->height;
    }
    if (image->width != *width || image->height != *height) {
      return invalid_input(text("outputs are ", *width, "x", *height, " and ", image->width, "x",
                                image->height, "; they must be of one size"));
    }
  }
  if (*width < 1 || *height < 1 || *width > 65535 || *height > 65535) {
    return invalid_input(
        text("outputs are ", *width, "x", *height, "; they must have sides in [1, 65535]"));
  }
  return {};
}

SurfaceGrid grid_of(const SurfaceScene& s) {
  SurfaceGrid g;
  const auto distance_stride = s.distance.strides();
  const auto stride = strides_of(s.volume);
  for (int a = 0; a < 3; ++a) {
    g.size[a] = s.volume.size[a];
    g.spacing[a] = s.volume.spacing[a];
    g.distance_stride[a] = distance_stride[a];
    g.stride[a] = stride[a];
  }
  g.distance = s.distance.data;
  g.samples = s.volume.data;
  g.type = s.volume.type;
  const float sign = s.solid == SolidSide::kAbove ? 1.0f : -1.0f;
  g.scale = sign * s.volume.slope;
  g.offset = sign * (s.volume.intercept - s.isovalue);
  return g;
}

// Places of a pixel's samples: the R2 sequence, moved so that their mean is the pixel's centre.
std::vector<std::array<float, 2>> sample_places(int count) {
  std::vector<std::array<float, 2>> places(static_cast<std::size_t>(count));
  double mean[2] = {};
  for (int i = 0; i < count; ++i) {
    const double steps[2] = {0.7548776662466927, 0.5698402909980532};
    for (int k = 0; k < 2; ++k) {
      const double v = 0.5 + i * steps[k];
      places[i][k] = static_cast<float>(v - std::floor(v));
      mean[k] += places[i][k] / count;
    }
  }
  for (auto& place : places) {
    for (int k = 0; k < 2; ++k) place[k] += static_cast<float>(0.5 - mean[k]);
  }
  return places;
}

class Renderer {
 public:
  Renderer(const SurfaceScene& scene, const SurfaceCamera& camera, const SurfaceSettings& settings,
           const SurfaceShader& shader, const SurfaceOutputs& outputs, int width, int height)
      : grid_(grid_of(scene)),
        camera_(camera),
        places_(sample_places(settings.samples_per_pixel)),
        shader_(shader),
        outputs_(outputs),
        width_(width),
        height_(height) {
    half_height_ = camera.orthographic ? camera.ortho_height / 2 : std::tan(camera.fov_y / 2);
    for (int a = 0; a < 3; ++a) last_[a] = static_cast<float>(grid_.size[a] - 1);
  }

  // Buffers of one thread.
  struct Scratch {
    std::vector<float> numbers;
    std::vector<SurfacePoint> points;
    std::vector<float> light;
    Status failure;
  };

  Status block(int block, Scratch& s) const {
    const int first = block * kBlockRows, end = std::min(height_, first + kBlockRows);
    const int samples = static_cast<int>(places_.size());
    const int count = (end - first) * width_ * samples;
    const int room = (count + kSurfaceRayGroup - 1) / kSurfaceRayGroup * kSurfaceRayGroup;
    s.numbers.resize(static_cast<std::size_t>(room) * 11);
    float* at = s.numbers.data();
    SurfaceRays rays;
    rays.count = count;
    for (float** array : {&rays.origin[0], &rays.origin[1], &rays.origin[2], &rays.direction[0],
                          &rays.direction[1], &rays.direction[2], &rays.hit, &rays.normal[0],
                          &rays.normal[1], &rays.normal[2], &rays.began_inside}) {
      *array = at;
      at += room;
    }
    fill(first, end, room, rays);
    trace_surface(grid_, rays);
    collect(rays, s);
    s.light.assign(s.points.size(), 1.0f);
    if (!s.points.empty() && shader_) {
      if (Status status = shader_(first, s.points, s.light); !status.ok()) return status;
    }
    resolve(first, end, rays, s);
    return {};
  }

 private:
  void fill(int first, int end, int room, const SurfaceRays& rays) const {
    int i = 0;
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < width_; ++x) {
        for (const auto& place : places_) {
          const float scale = 2 * half_height_ / static_cast<float>(height_);
          const float u =
              (static_cast<float>(x) + place[0] - 0.5f * static_cast<float>(width_)) * scale;
          const float v =
              (0.5f * static_cast<float>(height_) - static_cast<float>(y) - place[1]) * scale;
          Vec3 origin = camera_.eye, direction = camera_.forward;
          for (int a = 0; a < 3; ++a) {
            (camera_.orthographic ? origin : direction)[a] +=
                u * camera_.right[a] + v * camera_.up[a];
          }
          const float length = camera_.orthographic ? 1.0f : std::sqrt(dot(direction, direction));
          for (int a = 0; a < 3; ++a) {
            rays.origin[a][i] = origin[a] / grid_.spacing[a];
            rays.direction[a][i] = direction[a] / (length * grid_.spacing[a]);
          }
          ++i;
        }
      }
    }
    for (; i < room; ++i) {
      for (int a = 0; a < 3; ++a) {
        // Rays that miss, to fill the last vector.
        rays.origin[a][i] = -10;
        rays.direction[a][i] = -1;
      }
    }
  }

  // Turns hits into points of the surface, in order.
  void collect(const SurfaceRays& rays, Scratch& s) const {
    s.points.clear();
    for (int i = 0; i < rays.count; ++i) {
      if (!(rays.hit[i] < kInfinity)) continue;
      SurfacePoint point;
      Vec3 index;
      for (int a = 0; a < 3; ++a) {
        index[a] = rays.origin[a][i] + rays.hit[i] * rays.direction[a][i];
        point.position[a] = std::min(std::max(index[a], 0.0f), last_[a]) * grid_.spacing[a];
        point.normal[a] = rays.normal[a][i];
      }
      if (rays.began_inside[i] > 0) point.normal = cut_normal(rays, i, index);
      s.points.push_back(point);
    }
  }

  // The normal where matter is cut: that of the border, or against the ray if it starts in matter.
  Vec3 cut_normal(const SurfaceRays& rays, int i, const Vec3& index) const {
    Vec3 direction;
    for (int a = 0; a < 3; ++a) direction[a] = rays.direction[a][i] * grid_.spacing[a];
    int axis = -1;
    float closest = 1e-3f;
    for (int a = 0; a < 3; ++a) {
      const float margin = grid_.size[a] == 1 ? 0.5f : 0.0f;
      const float face = direction[a] > 0 ? -margin : last_[a] + margin;
      const float away = std::fabs(index[a] - face) / (1 + last_[a]);
      if (direction[a] != 0 && away < closest) {
        closest = away;
        axis = a;
      }
    }
    if (axis < 0 || rays.hit[i] <= 0) return {-direction[0], -direction[1], -direction[2]};
    Vec3 normal{};
    normal[axis] = direction[axis] > 0 ? -1.0f : 1.0f;
    return normal;
  }

  void resolve(int first, int end, const SurfaceRays& rays, const Scratch& s) const {
    const auto samples = static_cast<int>(places_.size());
    int i = 0;
    std::size_t point = 0;
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < width_; ++x) {
        float light = 0, depth = 0;
        int hits = 0;
        for (int k = 0; k < samples; ++k, ++i) {
          if (!(rays.hit[i] < kInfinity)) {
            light += 1;
            continue;
          }
          Vec3 way;
          for (int a = 0; a < 3; ++a) way[a] = rays.direction[a][i] * grid_.spacing[a];
          depth += rays.hit[i] * dot(way, camera_.forward);
          light += s.light[point++];
          ++hits;
        }
        const float n = static_cast<float>(samples), h = static_cast<float>(hits);
        if (!outputs_.visibility.empty()) outputs_.visibility(x, y) = light / n;
        if (!outputs_.coverage.empty()) outputs_.coverage(x, y) = h / n;
        if (!outputs_.depth.empty()) outputs_.depth(x, y) = hits > 0 ? depth / h : kInfinity;
      }
    }
  }

  const SurfaceGrid grid_;
  const SurfaceCamera& camera_;
  const std::vector<std::array<float, 2>> places_;
  const SurfaceShader& shader_;
  const SurfaceOutputs& outputs_;
  int width_, height_;
  float half_height_;
  float last_[3];
};

}  // namespace

Status render_surface(const SurfaceScene& scene, const SurfaceCamera& camera,
                      const SurfaceSettings& settings, const SurfaceShader& shader,
                      const SurfaceOutputs& outputs, const RunOptions& run) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_scene(scene); !s.ok()) return s;
  if (Status s = check_camera(camera); !s.ok()) return s;
  int width, height;
  if (Status s = check_outputs(outputs, &width, &height); !s.ok()) return s;
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  const Renderer renderer(scene, camera, settings, shader, outputs, width, height);
  std::vector<Renderer::Scratch> scratch(static_cast<std::size_t>(executor.thread_count()));
  const int blocks = (height + kBlockRows - 1) / kBlockRows;
  Progress progress(blocks, run.progress);
  std::atomic<bool> failed{false};
  executor.parallel_for(blocks, [&](int block, int worker) {
    if (progress.cancelled() || failed) return;
    Renderer::Scratch& mine = scratch[static_cast<std::size_t>(worker)];
    try {
      mine.failure = renderer.block(block, mine);
    } catch (const std::bad_alloc&) {
      mine.failure = {StatusCode::kOutOfMemory, "out of memory while rendering; use fewer samples"};
    }
    if (!mine.failure.ok()) failed = true;
    progress.advance();
  });
  for (const Renderer::Scratch& s : scratch) {
    if (!s.failure.ok()) return s.failure;
  }
  if (progress.cancelled()) {
    return {StatusCode::kCancelled, "the rendering was cancelled by the caller"};
  }
  return {};
}

}  // namespace obscura
