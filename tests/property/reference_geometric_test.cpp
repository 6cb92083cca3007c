#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "obscura/estimator.h"
#include "paths.h"
#include "scene/scenes/mesh_view.h"
#include "scene/truth/compare.h"
#include "scene/truth/geometric.h"

namespace obscura {
namespace {

using tools::Comparison;
using tools::GeometricSettings;
using tools::Rendering;

constexpr int kEvery = 32;

struct View {
  Rendering rendering;
  int width = 0, height = 0;
  std::vector<float> truth, mask;
  float radius = 0, offset_px = 0;
};

// A view with a guard band of 40 %, eight layers, open sheets of 0.5 % of the scene size, and its
// truth for an exponential falloff of 5 % of it. Rays start three pixels (at the median depth) off
// the surface on both sides.
void look_at(const std::string& spec, View* view) {
  const std::unique_ptr<Executor> executor = make_executor();
  tools::ViewOptions options;
  options.layers = 8;
  options.back_depth = true;
  Status s;
  if (tools::is_scene(spec)) {
    s = tools::load_scene(spec, options, *executor, &view->rendering);
  } else {
    tools::MeshOptions mesh;
    mesh.view = options;
    mesh.view.guard_band = {true, 40, 40};
    mesh.ground = true;
    s = tools::load_mesh(spec, mesh, *executor, &view->rendering);
  }
  ASSERT_TRUE(s.ok()) << s.message();
  const tools::DepthInput& g = view->rendering.gbuffer;
  const DepthField field = g.field();
  view->width = field.visible().width;
  view->height = field.visible().height;
  std::vector<float> depths;
  for (int y = 0; y < view->height; ++y) {
    for (int x = 0; x < view->width; ++x) {
      view->mask.push_back(field.depth(x + g.guard_band.left, y + g.guard_band.top));
      if (std::isfinite(view->mask.back())) depths.push_back(view->mask.back());
    }
  }
  std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
  view->offset_px = 3;
  view->radius = static_cast<float>(0.05 * g.scene_size);
  GeometricSettings settings;
  settings.falloff.radius = view->radius;
  settings.rays = 512;
  settings.every = kEvery;
  settings.offset = 3.0 * g.camera.scale_x * depths[depths.size() / 2];
  view->truth.resize(view->mask.size());
  const Outputs outputs{.visibility = {view->truth.data(), view->width, view->height}};
  const Status traced =
      tools::trace_geometric(view->rendering, settings, outputs, {.executor = executor.get()});
  ASSERT_TRUE(traced.ok()) << traced.message();
}

double error_of(const View& view, const Occluder& occluder) {
  ReferenceSettings settings{.occluder = Occluder::solid()};
  settings.falloff.radius = view.radius;
  settings.occluder = occluder;
  settings.rays = 512;
  settings.every = kEvery;
  settings.offset_px = view.offset_px;
  std::vector<float> visibility(view.truth.size());
  const Outputs outputs{.visibility = {visibility.data(), view.width, view.height}};
  const Status s = compute(view.rendering.gbuffer.field(), settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  auto image = [&](const std::vector<float>& v) {
    return ImageView<const float>(v.data(), view.width, view.height);
  };
  Comparison c;
  EXPECT_TRUE(tools::compare(image(visibility), image(view.truth), image(view.mask), &c).ok());
  return c.e_a;
}

// Errors (e_A: mean |difference|, per cent) of the four models of thickness.
struct Errors {
  double solid = 0, thickness = 0, back_depth = 0, layers = 0;
};

Errors errors_of(const std::string& spec) {
  View view;
  look_at(spec, &view);
  if (testing::Test::HasFatalFailure()) return {};
  const auto thickness = static_cast<float>(0.02 * view.rendering.gbuffer.scene_size);
  return {error_of(view, Occluder::solid()), error_of(view, Occluder::of_thickness(thickness)),
          error_of(view, Occluder::back_depth()), error_of(view, Occluder::of_layers(8))};
}

// Layers come near the real geometry in every view, and each coarser model is farther off than the
// next, in the mean of the views.
TEST(ReferenceGeometric, LayersComeNearTheWorld) {
  std::vector<std::string> views = {"scene:cornell?size=640x360&guard-band=40%",
                                    "scene:tower?size=640x360&guard-band=40%"};
  const std::filesystem::path bunny =
      OBSCURA_SOURCE_DIR "/../shared/data/meshes/stanford-bunny.obj";
  if (std::filesystem::exists(bunny)) views.push_back(bunny.string());
  Errors sum;
  for (const std::string& spec : views) {
    SCOPED_TRACE(spec);
    const Errors e = errors_of(spec);
    EXPECT_LE(e.layers, 1);
    sum.layers += e.layers;
    sum.back_depth += e.back_depth;
    sum.thickness += e.thickness;
    sum.solid += e.solid;
  }
  EXPECT_LT(sum.layers, sum.back_depth);
  EXPECT_LT(sum.back_depth, sum.thickness);
  EXPECT_LT(sum.thickness, sum.solid);
}

}  // namespace
}  // namespace obscura
