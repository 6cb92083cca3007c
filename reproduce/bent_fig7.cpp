// Figure 7 of bent normals and cones: angles between screen-space and ray-traced bent normals.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "reproduce/bent.h"
#include "reproduce/bent_scenes.h"

namespace obscura::tools {
namespace {

constexpr int kSize = 512, kRays = 1024, kEvery = 4;

// Degrees between the directions, NaN where either has none.
Image angles(const VectorView<float>& a, const VectorView<float>& b, const Rendering& rendering) {
  const DepthInput& g = rendering.gbuffer;
  Image image(a.x.width, a.x.height);
  std::vector<float>& out = image.add("Y");
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double dot = double{a.x(x, y)} * b.x(x, y) + double{a.y(x, y)} * b.y(x, y) +
                         double{a.z(x, y)} * b.z(x, y);
      const std::size_t at = std::size_t(y + g.guard_band.top) * g.width + x + g.guard_band.left;
      out[std::size_t(y) * image.width + x] =
          std::isfinite(g.depth[at])
              ? float(std::acos(std::clamp(dot, -1.0, 1.0)) * 180 / std::numbers::pi)
              : NAN;
    }
  }
  return image;
}

// Over the pixels that were traced.
double mean(const Image& image) {
  double sum = 0;
  std::int64_t count = 0;
  for (int y = kEvery / 2; y < image.height; y += kEvery) {
    for (int x = kEvery / 2; x < image.width; x += kEvery) {
      const float v = image.channels[0].values[std::size_t(y) * image.width + x];
      if (std::isnan(v)) continue;
      sum += v;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : NAN;
}

// The paper's 8x difference: white at 180 / 8 degrees.
Image eightfold(const Image& degrees) {
  Image picture = degrees;
  for (float& v : picture.channels[0].values) v = std::isnan(v) ? 0 : std::min(8 * v / 180, 1.0f);
  return picture;
}

struct Entry {
  const char* name;
  MethodSettings settings;
};
std::vector<Entry> entries(const Falloff& falloff) {
  auto hemisphere = [&](int samples, int steps) {
    return HemisphereSettings{
        .falloff = falloff, .occluder = Occluder::solid(), .samples = samples, .steps = steps};
  };
  return {{"8 samples, no steps", hemisphere(8, 0)},
          {"8 samples, 3 steps", hemisphere(8, 3)},
          {"16 samples, 3 steps", hemisphere(16, 3)},
          {"16 samples, 8 steps", hemisphere(16, 8)},
          {"far field, fast",
           FarFieldSettings{
               .falloff = falloff, .occluder = Occluder::solid(), .preset = FarFieldPreset::kFast}},
          {"far field", FarFieldSettings{.falloff = falloff, .occluder = Occluder::solid()}}};
}

}  // namespace

Status reproduce_bent_fig7(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  RunOptions options;
  options.executor = executor.get();
  double done = 0;
  for (const std::string& scene : bent_scenes()) {
    if (!context.step(scene, done++ / 4)) return {StatusCode::kCancelled, "stopped by the user"};
    Rendering rendering;
    if (Status s = load_bent_scene(scene, kSize, *executor, &rendering); !s.ok()) return s;
    const DepthField field = rendering.gbuffer.field();
    BentBuffers truth(kSize, kSize), fast(kSize, kSize);
    const ReferenceSettings reference{.falloff = bent_falloff(rendering),
                                      .occluder = Occluder::solid(),
                                      .rays = kRays,
                                      .every = kEvery,
                                      .interpolate = true};
    Outputs outputs = truth.directions();
    if (Status s = compute(field, reference, outputs, options); !s.ok()) return s;
    report->add(scene, "normal itself", mean(angles(truth.normal, truth.bent, rendering)),
                "degrees");
    double of_16_samples = 0;
    for (const Entry& e : entries(bent_falloff(rendering))) {
      if (Status s = compute(field, e.settings, fast.directions(), options); !s.ok()) return s;
      const double angle = mean(angles(fast.bent, truth.bent, rendering));
      report->add(scene, e.name, angle, "degrees");
      if (e.name == std::string("16 samples, 3 steps")) of_16_samples = angle;
      if (e.name == std::string("far field")) {
        report->add(scene, "far field : 16 samples", angle / of_16_samples, "", 0.5);
      }
    }
    if (Status s = context.picture(
            scene,
            beside({{"ray-traced", vector_picture(truth.bent)},
                    {"far field", vector_picture(fast.bent)},
                    {"difference, 8 times", eightfold(angles(fast.bent, truth.bent, rendering))}}));
        !s.ok()) {
      return s;
    }
  }
  *text += fmt::format(
      "Mean angle between bent normals (of hemisphere sampling where samples are named) and those "
      "of {} rays against the "
      "same "
      "depth field, at every {}th pixel of {}x{} (the pictures interpolate between them); nothing "
      "occludes beyond a "
      "tenth of the scene. *Normal itself* is the angle that bent normals are bent by.\n",
      kRays, kEvery, kSize, kSize);
  return {};
}

}  // namespace obscura::tools
