#include "scene/rays/gbuffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/rays/intervals.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// Rays whose parameter is the linear depth.
class PixelRays {
 public:
  explicit PixelRays(const ViewSpec& view)
      : eye_(view.eye), frame_(view.frame()), camera_(view.camera()) {}

  Vec3 origin(int x, int y) const {
    return camera_.orthographic ? eye_ + frame_.to_world({a(x), b(y), 0}) : eye_;
  }
  // In eye space, with z = -1.
  Vec3 eye_direction(int x, int y) const {
    return camera_.orthographic ? Vec3{0, 0, -1} : Vec3{a(x), b(y), -1};
  }
  const Frame& frame() const { return frame_; }

 private:
  double a(int x) const { return (x + 0.5 - camera_.center_u) * camera_.scale_x; }
  double b(int y) const { return (camera_.center_v - (y + 0.5)) * camera_.scale_y; }

  Vec3 eye_;
  Frame frame_;
  Camera camera_;
};

Status check(const RayScene& scene, const ViewSpec& view, const LayerSpec& layers) {
  if (Status s = validate(view); !s.ok()) return s;
  if (layers.layers < 0 || layers.layers > 64) {
    return invalid_argument(fmt::format("layers is {}; it must be in [0, 64]", layers.layers));
  }
  if (!(layers.sheet_thickness >= 0 && std::isfinite(layers.sheet_thickness))) {
    return invalid_argument(
        fmt::format("sheet-thickness is {:g}; it must be in [0, inf)", layers.sheet_thickness));
  }
  if (scene.part_around(view.eye) >= 0) {
    return invalid_argument(fmt::format("eye {:g},{:g},{:g} lies inside a solid; move it out",
                                        view.eye.x, view.eye.y, view.eye.z));
  }
  return {};
}

}  // namespace

Status render_gbuffer(const RayScene& scene, const ViewSpec& view, const LayerSpec& spec,
                      Executor& executor, DepthInput* input) {
  if (Status s = check(scene, view, spec); !s.ok()) return s;
  DepthInput out;
  out.name = input->name;
  out.width = view.full_width();
  out.height = view.full_height();
  out.camera = view.camera();
  out.guard_band = view.guard_band;
  out.scene_size = scene.mesh().scene_size;
  const std::size_t pixels = std::size_t(out.width) * out.height;
  out.depth.assign(pixels, kInf);
  out.normal_x.assign(pixels, 0);
  out.normal_y.assign(pixels, 0);
  out.normal_z.assign(pixels, 1);
  if (spec.back_depth) out.back_depth.assign(pixels, kInf);
  out.layers.resize(spec.layers);
  for (DepthInput::Layer& layer : out.layers) {
    layer.front.assign(pixels, kInf);
    layer.back.assign(pixels, kInf);
  }
  const double sheet_length =
      spec.sheet_thickness > 0 ? spec.sheet_thickness : 0.005 * out.scene_size;
  const bool layered = spec.back_depth || spec.layers > 0;
  struct Scratch {
    std::vector<RayScene::Hit> hits;
    std::vector<Interval> matter;
  };
  std::vector<Scratch> scratch(executor.thread_count());
  const PixelRays rays(view);
  executor.parallel_for(out.height, [&](int y, int worker) {
    auto& [hits, matter] = scratch[worker];
    for (int x = 0; x < out.width; ++x) {
      const std::size_t i = std::size_t(y) * out.width + x;
      const Vec3 eye_direction = rays.eye_direction(x, y);
      const Vec3 origin = rays.origin(x, y), direction = rays.frame().to_world(eye_direction);
      RayScene::Hit hit;
      if (!scene.intersect(origin, direction, &hit) || !(float(hit.t) > 0)) continue;
      out.depth[i] = float(hit.t);
      const double side = dot(hit.normal, direction) > 0 ? -1 : 1;
      const Vec3 normal = rays.frame().from_world(hit.normal * side);
      out.normal_x[i] = float(normal.x);
      out.normal_y[i] = float(normal.y);
      out.normal_z[i] = float(normal.z);
      if (!layered) continue;
      scene.intersect_all(origin, direction, &hits);
      const double sheet = sheet_length / length(eye_direction);
      find_matter(scene, direction, sheet, &hits, &matter);
      // The first surface counts as matter, even if its triangle was too thin to be crossed twice.
      if (matter.empty()) matter.push_back({hit.t, hit.t + sheet});
      matter[0].front = hit.t;
      for (int k = 0; k < std::min<int>(spec.layers, int(matter.size())); ++k) {
        out.layers[k].front[i] = float(matter[k].front);
        out.layers[k].back[i] = float(std::max(matter[k].front, matter[k].back));
      }
      if (spec.back_depth) out.back_depth[i] = std::max(out.depth[i], float(matter[0].back));
    }
  });
  *input = std::move(out);
  return {};
}

}  // namespace obscura::tools
