#include <gtest/gtest.h>

#include <cmath>

#include "hwy/targets.h"
#include "screen/reference/depth_scene.h"
#include "screen/reference/pixel_tracer.h"
#include "tests/property/synthetic.h"
#include "tests/reference/marched_rays.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kWidth = 45, kHeight = 37;

// Layers of matter of random depth and extent, some texels with none, some backs at infinity.
void add_matter(const synthetic::Input& input, std::vector<std::vector<float>>* images) {
  Random random(11);
  images->assign(6, {});
  for (std::size_t i = 0; i < input.depth.size(); ++i) {
    float at = input.depth[i];
    for (int k = 0; k < 3; ++k) {
      const float back = at + 0.02f + static_cast<float>(0.3 * random.uniform());
      (*images)[2 * k].push_back(at);
      (*images)[2 * k + 1].push_back(random.below(20) == 0 ? kInf : back);
      at = random.below(3) == 0 ? kInf : back + static_cast<float>(random.uniform());
    }
  }
}

struct Case {
  const char* name;
  Occluder occluder;
  bool orthographic;
};

// Every ray of every SIMD target against the march, under an off-centre camera with oblong pixels.
TEST(ReferenceTrace, EveryTargetAgreesWithMarching) {
  const std::unique_ptr<Executor> executor = make_executor(1);
  Random random(3);
  for (const Case& c : {Case{"solid", Occluder::solid(), false},
                        {"solid, parallel", Occluder::solid(), true},
                        {"thickness", Occluder::of_thickness(0.2f), false},
                        {"back-depth, parallel", Occluder::back_depth(), true},
                        {"layers", Occluder::of_layers(3), false}}) {
    SCOPED_TRACE(c.name);
    const Camera camera = synthetic::random_camera(kWidth, kHeight, c.orthographic, &random);
    const synthetic::Input input = synthetic::blocks(kWidth, kHeight, camera, 17);
    std::vector<std::vector<float>> matter;
    add_matter(input, &matter);
    DepthField field = input.field();
    auto view_of = [&](int i) { return ImageView<const float>(matter[i].data(), kWidth, kHeight); };
    const DepthLayer layers[] = {
        {view_of(0), view_of(1)}, {view_of(2), view_of(3)}, {view_of(4), view_of(5)}};
    field.layers = layers;
    field.back_depth = view_of(1);
    view::Geometry g;
    const bool back = c.occluder.kind == OccluderKind::kBackDepth;
    ASSERT_TRUE(view::convert(field, {true, back, c.occluder.layers}, *executor, &g).ok());
    DepthScene depth_scene;
    depth_scene.build(g, c.occluder, *executor);
    TraceScene scene = depth_scene.trace();
    scene.max_distance = scene.beyond_border = kInf;
    const reference::MarchedRays marched(g, c.occluder);
    ReferenceSettings settings{.occluder = Occluder::solid()};
    // Grazing rays are not for the march to tell; also boxes may be left from within.
    settings.offset_px = 0.3f;
    const PixelTracer::Frame frame{&g, &scene, nullptr, &settings, true, false};

    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      // The same rays for every target, and a threshold of its own: which processor this is does
      // not matter.
      Random pixels(23);
      int rays = 0, blocked = 0, wrong = 0;
      RayBatch batch{};
      for (int i = 0; i < 120; ++i) {
        const Pixel pixel{pixels.below(kWidth), pixels.below(kHeight)};
        if (std::isinf(g.depth(pixel.x, pixel.y))) continue;
        const Receiver r = make_receiver(frame, pixel);
        batch.count = 0;
        add_rays(scene, r, {.uniform = i % 2 == 0, .size = 19, .first = 0, .count = 19, .seed = 5},
                 &batch);
        scene.boxes ? trace_boxes(scene, &batch) : trace_surface(scene, &batch);
        finish_rays(&batch);
        const double half = scene.boxes ? 0 : 0.5;
        const double depth = c.orthographic ? -(double{r.reference} + r.height) : r.depth;
        const double unit = c.orthographic ? 1 : depth;
        const double p[] = {(r.x + half - camera.center_u) * camera.scale_x * unit,
                            (camera.center_v - r.y - half) * camera.scale_y * unit, -depth};
        for (int k = 0; k < batch.count; ++k) {
          const double w[] = {batch.wx[k], batch.wy[k], batch.wz[k]};
          EXPECT_NEAR(w[0] * w[0] + w[1] * w[1] + w[2] * w[2], 1, 1e-5);
          const double expected = marched.distance(p, w), found = batch.distance[k];
          ++rays;
          blocked += std::isfinite(expected);
          const bool same = std::isinf(expected)
                                ? std::isinf(found)
                                : std::abs(found - expected) < 0.02 * expected + 0.011;
          wrong += !same;
        }
      }
      EXPECT_GT(blocked, rays / 20);
      EXPECT_LE(wrong, rays / 150) << rays << " rays, " << blocked << " blocked";
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

// Directions of a net: unit, in the hemisphere, with the means that their density has.
TEST(ReferenceTrace, NetsHaveTheirDensity) {
  TraceScene scene;
  scene.scale_x = scene.scale_y = 1;
  scene.cells_x = scene.cells_y = 1;
  Receiver r;
  r.normal[2] = r.tangent[0] = r.bitangent[1] = 1;
  RayBatch batch{};
  for (const bool uniform : {false, true}) {
    for (const int size : {1000, 1024}) {
      batch.count = 0;
      add_rays(scene, r, {.uniform = uniform, .size = size, .first = 0, .count = size, .seed = 9},
               &batch);
      double x = 0, y = 0, z = 0, zz = 0;
      for (int i = 0; i < size; ++i) {
        EXPECT_GE(batch.wz[i], 0);
        x += batch.wx[i] / size;
        y += batch.wy[i] / size;
        z += batch.wz[i] / size;
        zz += batch.wz[i] * batch.wz[i] / size;
      }
      EXPECT_NEAR(x, 0, 2e-3);
      EXPECT_NEAR(y, 0, 2e-3);
      EXPECT_NEAR(z, uniform ? 1.0 / 2 : 2.0 / 3, 2e-3);
      EXPECT_NEAR(zz, uniform ? 1.0 / 3 : 1.0 / 2, 2e-3);
    }
  }
}

}  // namespace
}  // namespace obscura
