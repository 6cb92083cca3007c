#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "obscura/obscura.h"
#include "paths.h"
#include "scene/scenes/mesh_view.h"
#include "scene/truth/geometric.h"

// Two references that share only their input must agree where the depth image's model of thickness
// is close to the real geometry, and differ more the coarser the model is.

namespace obscura {
namespace {

using tools::Rendering;

tools::ViewOptions view_options() {
  tools::ViewOptions view;
  EXPECT_TRUE(parse_setting("guard-band", {}, "40%", &view.guard_band).ok());
  view.layers = 8;
  view.back_depth = true;
  return view;
}

// Mean absolute difference of the screen-space reference from the geometric one, with a falloff of
// 5 % of the scene size, in per cent over a subset of the pixels with a surface.
class Models {
 public:
  explicit Models(const Rendering& r) : r_(r), truth_(pixels(), NAN) {
    tools::GeometricSettings s;
    s.falloff.radius = radius();
    s.rays = 256;
    s.every = kEvery;
    EXPECT_TRUE(trace_geometric(r, s, outputs(&truth_)).ok());
  }

  float radius() const { return float(0.05 * r_.gbuffer.scene_size); }

  double difference(const Occluder& occluder) const {
    ReferenceSettings s{.occluder = Occluder::solid()};
    s.falloff.radius = radius();
    s.occluder = occluder;
    s.rays = 256;
    s.every = kEvery;
    // The smallest that keeps receivers out of their own texels on these slopes; at 3 pixels small
    // reliefs are jumped over.
    s.offset_px = 1;
    std::vector<float> values(pixels());
    const Status status = compute(r_.gbuffer.field(), s, outputs(&values));
    EXPECT_TRUE(status.ok()) << status.message();
    double sum = 0;
    int count = 0;
    const tools::DepthInput& g = r_.gbuffer;
    for (int y = kEvery / 2; y < r_.view.height; y += kEvery) {
      for (int x = kEvery / 2; x < r_.view.width; x += kEvery) {
        const std::size_t i = std::size_t(y) * r_.view.width + x;
        if (!std::isfinite(
                g.depth[std::size_t(y + g.guard_band.top) * g.width + x + g.guard_band.left])) {
          continue;
        }
        sum += std::abs(values[i] - truth_[i]);
        ++count;
      }
    }
    EXPECT_GT(count, 300);
    return 100 * sum / count;
  }

 private:
  static constexpr int kEvery = 9;

  std::size_t pixels() const { return std::size_t(r_.view.width) * r_.view.height; }
  Outputs outputs(std::vector<float>* values) const {
    return {.visibility = {values->data(), r_.view.width, r_.view.height}};
  }

  const Rendering& r_;
  std::vector<float> truth_;
};

void expect_order(const Rendering& r, const char* what) {
  const Models models(r);
  const double solid = models.difference(Occluder::solid());
  const double thickness = models.difference(Occluder::of_thickness(0.4f * models.radius()));
  const double back_depth = models.difference(Occluder::back_depth());
  const double layers = models.difference(Occluder::of_layers(8));
  EXPECT_LE(layers, 1) << what;
  EXPECT_LE(layers, back_depth + 0.05) << what;
  EXPECT_LT(back_depth, thickness) << what;
  EXPECT_LT(thickness, solid) << what;
  testing::Test::RecordProperty(what, std::to_string(layers));
}

TEST(ModelsOfMatter, InTheScenes) {
  for (const char* spec : {"scene:cornell", "scene:tower"}) {
    Rendering r;
    ASSERT_TRUE(tools::load_scene(spec, view_options(), *make_executor(), &r).ok());
    expect_order(r, spec);
  }
}

TEST(ModelsOfMatter, OfTheBunny) {
  const std::string path = OBSCURA_SOURCE_DIR "/../shared/data/meshes/stanford-bunny.obj";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the bunny is not there: " << path;
  Rendering r;
  tools::MeshOptions options;
  options.view = view_options();
  options.ground = true;
  ASSERT_TRUE(tools::load_mesh(path, options, *make_executor(), &r).ok());
  const Models models(r);
  // A mesh with holes, so it is a sheet: its back depth is that of a thin surface, not of the whole
  // animal.
  EXPECT_LE(models.difference(Occluder::of_layers(8)), 1);
  EXPECT_LT(models.difference(Occluder::of_layers(8)), models.difference(Occluder::solid()));
}

}  // namespace
}  // namespace obscura
