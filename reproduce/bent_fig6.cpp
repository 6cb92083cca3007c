// Figure 6 of bent normals and cones, in numbers: how far light from each technique is from the
// truth.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "reproduce/bent.h"
#include "reproduce/bent_scenes.h"

namespace obscura::tools {
namespace {

constexpr int kSize = 1024, kEvery = 16;
constexpr int kTruthRays = 4096, kRays = 1024;

enum Buffers { kUniformCones, kCosineCones, kUniformVisibility };
struct Technique {
  const char* name;
  Buffers buffers;
  LightingSettings settings;
};
const Technique kTechniques[] = {
    {"AO", kUniformCones, {.technique = LightingTechnique::kAmbientOcclusion}},
    {"bent normal", kUniformCones, {.technique = LightingTechnique::kBentNormal}},
    {"bent cone", kUniformCones, {.technique = LightingTechnique::kBentCone}},
    {"cosine cone", kCosineCones, {.technique = LightingTechnique::kBentCone}},
    {"paper's cone",
     kUniformVisibility,
     {.technique = LightingTechnique::kBentCone,
      .geometric_term = true,
      .normalisation = ConeNormalisation::kPaper,
      .weights = VisibilityWeights::kUniform}},
};
constexpr std::size_t kCount = std::size(kTechniques);

struct Sums {
  double log_ratio[kCount] = {};  // to the first technique
  int count = 0;
};

// Uniform visibility from the far field's outputs: |N| = 2 AO |N_ss| and |N_ss| = (1 + cos a) / 2.
Status uniform_visibility(const DepthField& field, const FarFieldSettings& settings,
                          const RunOptions& options, BentBuffers* buffers) {
  Outputs o;
  o.normal = buffers->normal, o.uniform_integral = buffers->bent, o.cone_angle = buffers->angle;
  if (Status s = compute(field, settings, o, options); !s.ok()) return s;
  const VectorView<float>& n = buffers->bent;
  for (int y = 0; y < n.x.height; ++y) {
    for (int x = 0; x < n.x.width; ++x) {
      const float length = std::hypot(n.x(x, y), n.y(x, y), n.z(x, y));
      buffers->visibility(x, y) = std::min(length / (1 + std::cos(buffers->angle(x, y))), 1.0f);
    }
  }
  return {};
}

// Visibility and directions of one estimator, in the three forms that the techniques read.
template <class Settings>
Status estimate(const Rendering& rendering, Settings settings, const RunOptions& options,
                std::vector<BentBuffers>* buffers) {
  const DepthField field = rendering.gbuffer.field();
  for (int k = 0; k < 3; ++k) {
    buffers->emplace_back(rendering.view.width, rendering.view.height);
  }
  BentBuffers& cosine = (*buffers)[kCosineCones];
  if (Status s = compute(field, settings, (*buffers)[kUniformCones].directions(), options);
      !s.ok()) {
    return s;
  }
  if (Status s = compute(field, settings, cosine.cosine_directions(), options); !s.ok()) return s;
  BentBuffers& uniform = (*buffers)[kUniformVisibility];
  if constexpr (std::is_same_v<Settings, FarFieldSettings>) {
    if (Status s = uniform_visibility(field, settings, options, &uniform); !s.ok()) return s;
  } else {
    settings.weighting = RayWeighting::kUniform;
    if (Status s = compute(field, settings, uniform.directions(), options); !s.ok()) return s;
  }
  return cones_from_cosine_integral(cosine.visibility, cosine.bent, cosine.bent, cosine.angle,
                                    options);
}

Status compare_lights(const std::string& scene, const Rendering& rendering,
                      const std::vector<BentBuffers>& buffers,
                      const std::vector<NamedLight>& lights, const std::vector<Image>& truths,
                      Executor& executor, Report* report, Sums* sums) {
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const std::string name = scene + ", " + lights[l].name;
    double errors[kCount];
    for (std::size_t t = 0; t < kCount; ++t) {
      Image rgb;
      if (Status s = lit_by(buffers[kTechniques[t].buffers], rendering, lights[l],
                            kTechniques[t].settings, executor, &rgb);
          !s.ok()) {
        return s;
      }
      errors[t] = rmse(rgb, truths[l], rendering);
      report->add(name, kTechniques[t].name, errors[t]);
      sums->log_ratio[t] += std::log(errors[t] / errors[0]);
    }
    report->add(name, "cosine cone : AO", errors[3] / errors[0]);
    ++sums->count;
  }
  return {};
}

void add_means(const char* name, const Sums& sums, Report* report) {
  for (std::size_t t = 0; t < kCount; ++t) {
    report->add(name, kTechniques[t].name, std::exp(sums.log_ratio[t] / sums.count));
  }
  report->add(name, "cosine cone : AO", std::exp(sums.log_ratio[3] / sums.count), "", 0.8);
}

Status make_pictures(const ReproduceContext& context, const Rendering& rendering,
                     const std::vector<BentBuffers>& buffers, const NamedLight& light,
                     const std::string& scene, Executor& executor) {
  Image ao, cone;
  for (auto [t, image] : {std::pair{0, &ao}, std::pair{3, &cone}}) {
    if (Status s = lit_by(buffers[kTechniques[t].buffers], rendering, light,
                          kTechniques[t].settings, executor, image);
        !s.ok()) {
      return s;
    }
  }
  // A white that leaves one pixel in a hundred brighter.
  std::vector<float> values = ao.channels[1].values;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 100 * 99);
  std::nth_element(values.begin(), at, values.end());
  const double white = std::max(double{*at}, 1e-6);
  return context.picture(scene, beside({{"visibility times irradiance", tone(ao, white)},
                                        {"bent cone", tone(cone, white)}}));
}

}  // namespace

Status reproduce_bent_fig6(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  RunOptions options;
  options.executor = executor.get();
  std::vector<NamedLight> lights;
  if (Status s = bent_lights(context.data, *executor, &lights); !s.ok()) return s;
  Sums marched, swept, exact;
  double done = 0;
  for (const std::string& scene : bent_scenes()) {
    Rendering rendering;
    if (Status s = load_bent_scene(scene, kSize, *executor, &rendering); !s.ok()) return s;
    std::vector<Image> truths(lights.size());
    for (std::size_t l = 0; l < lights.size(); ++l) {
      if (!context.step(scene, done / static_cast<double>(4 * (lights.size() + 1)))) {
        return {StatusCode::kCancelled, "stopped by the user"};
      }
      if (Status s = lit_truth(rendering, lights[l].environment, kTruthRays, kEvery, *executor,
                               &truths[l]);
          !s.ok()) {
        return s;
      }
      ++done;
    }
    const Falloff falloff = bent_falloff(rendering);
    std::vector<BentBuffers> hemisphere, far_field, traced;
    auto rows = [&](const auto& settings, const std::string& name,
                    std::vector<BentBuffers>* buffers, Sums* sums) {
      if (Status s = estimate(rendering, settings, options, buffers); !s.ok()) return s;
      return compare_lights(scene + name, rendering, *buffers, lights, truths, *executor, report,
                            sums);
    };
    if (Status s = rows(FarFieldSettings{.falloff = falloff, .occluder = Occluder::solid()}, "",
                        &far_field, &swept);
        !s.ok()) {
      return s;
    }
    if (Status s = rows(
            HemisphereSettings{
                .falloff = falloff, .occluder = Occluder::solid(), .samples = 16, .steps = 3},
            ", hemisphere", &hemisphere, &marched);
        !s.ok()) {
      return s;
    }
    if (Status s = rows(
            ReferenceSettings{
                .falloff = falloff, .occluder = Occluder::solid(), .rays = kRays, .every = kEvery},
            ", traced", &traced, &exact);
        !s.ok()) {
      return s;
    }
    if (Status s = make_pictures(context, rendering, far_field, lights[0], scene, *executor);
        !s.ok()) {
      return s;
    }
    ++done;
  }
  add_means("geometric mean of ratios to AO", swept, report);
  add_means("geometric mean, hemisphere", marched, report);
  add_means("geometric mean, traced", exact, report);
  *text += fmt::format(
      "RMSE of linear RGB against the truth of the depth field, whose rays carry their radiance: "
      "{} rays at every {}th pixel of {}x{}; nothing occludes beyond a tenth of the scene. "
      "Directions of the far field with its default settings; in rows marked *hemisphere* of 16 "
      "samples of 3 steps, in rows marked *traced* of {} rays, so that only the technique errs. "
      "AO is visibility times the irradiance of the normal.\n",
      kTruthRays, kEvery, kSize, kSize, kRays);
  return {};
}

}  // namespace obscura::tools
