#include "reproduce/bent_scenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "fmt/format.h"
#include "io/environments/environment_file.h"
#include "scene/light/comparators.h"

namespace obscura::tools {
namespace {

constexpr float kSunRadius = 0.0873f;  // 5 degrees: a hard sun that rays still find

// Three soft lamps of different colours in a dim room.
Status make_lamps(Executor& executor, Environment* environment) {
  constexpr int kWidth = 256, kHeight = 128;
  std::vector<float> rgb(std::size_t{3} * kWidth * kHeight);
  struct Lamp {
    double x, y, z, cosine, r, g, b;
  };
  constexpr Lamp kLamps[] = {{0.8, 0.5, 0.33, 0.9, 6, 5, 4},
                             {-0.86, 0.3, 0.4, 0.85, 1, 2, 4},
                             {0, 0.6, -0.8, 0.95, 5, 2, 1}};
  for (int y = 0; y < kHeight; ++y) {
    const double theta = std::numbers::pi * (y + 0.5) / kHeight;
    for (int x = 0; x < kWidth; ++x) {
      const double phi = 2 * std::numbers::pi * ((x + 0.5) / kWidth - 0.5);
      const double d[3] = {std::sin(theta) * std::sin(phi), std::cos(theta),
                           -std::sin(theta) * std::cos(phi)};
      double c[3] = {0.1, 0.1, 0.1};
      for (const Lamp& lamp : kLamps) {
        if (d[0] * lamp.x + d[1] * lamp.y + d[2] * lamp.z < lamp.cosine) continue;
        c[0] += lamp.r, c[1] += lamp.g, c[2] += lamp.b;
      }
      for (int k = 0; k < 3; ++k) rgb[(std::size_t(y) * kWidth + x) * 3 + k] = float(c[k]);
    }
  }
  return Environment::from_lat_long(VectorView<float>::interleaved(rgb.data(), kWidth, kHeight),
                                    environment, nullptr, {.executor = &executor});
}

Status add_light(const std::string& name, const Environment& environment, Executor& executor,
                 std::vector<NamedLight>* lights) {
  NamedLight light{name, environment, {}};
  RunOptions options;
  options.executor = &executor;
  const Status s = PreconvolvedEnvironment::make(environment, {}, &light.convolved, options);
  if (s.ok()) lights->push_back(std::move(light));
  return s;
}

}  // namespace

const std::vector<std::string>& bent_scenes() {
  static const std::vector<std::string> names = {"hall", "meadow", "cornell", "tower"};
  return names;
}

Status load_bent_scene(const std::string& name, int size, Executor& executor,
                       Rendering* rendering) {
  ViewOptions options;
  options.size = {size, size};
  return load_scene("scene:" + name, options, executor, rendering);
}

Falloff bent_falloff(const Rendering& rendering) {
  return {.kind = FalloffKind::kConstant,
          .radius = static_cast<float>(0.1 * rendering.gbuffer.scene_size)};
}

BentBuffers::BentBuffers(int width, int height) : image(width, height) {
  for (const char* name : {"v", "a", "nx", "ny", "nz", "bx", "by", "bz"}) image.add(name);
  visibility = image.view(0), angle = image.view(1);
  normal = {image.view(2), image.view(3), image.view(4)};
  bent = {image.view(5), image.view(6), image.view(7)};
}

Outputs BentBuffers::directions() {
  Outputs o;
  o.visibility = visibility, o.normal = normal, o.bent_normal = bent, o.cone_angle = angle;
  return o;
}

Outputs BentBuffers::cosine_directions() {
  Outputs o;
  o.visibility = visibility, o.normal = normal, o.cosine_integral = bent;
  return o;
}

Status bent_lights(const std::string& data, Executor& executor, std::vector<NamedLight>* lights) {
  const std::string folder = data + "/environments";
  std::error_code error;
  if (!data.empty() && std::filesystem::is_directory(folder, error)) {
    for (const char* name : {"forest", "venice", "studio"}) {
      EnvironmentSource source;
      Environment environment;
      EnvironmentRepairs repairs;
      if (Status s = open_environment(fmt::format("{}/{}.hdr", folder, name), &source); !s.ok()) {
        return s;
      }
      if (Status s = load_environment(source, &environment, &repairs, {.executor = &executor});
          !s.ok())
        return s;
      if (Status s = add_light(name, environment, executor, lights); !s.ok()) return s;
    }
  } else {
    Environment clear, overcast, lamps;
    const SkySettings without_sun{.elevation_deg = 25, .sun = 0};
    if (Status s = Environment::from_sky(without_sun, &clear, {.executor = &executor}); !s.ok())
      return s;
    if (Status s = Environment::from_sky({.model = SkyModel::kOvercast}, &overcast,
                                         {.executor = &executor});
        !s.ok()) {
      return s;
    }
    if (Status s = make_lamps(executor, &lamps); !s.ok()) return s;
    if (Status s = add_light("clear sky", clear, executor, lights); !s.ok()) return s;
    if (Status s = add_light("overcast sky", overcast, executor, lights); !s.ok()) return s;
    if (Status s = add_light("lamps", lamps, executor, lights); !s.ok()) return s;
  }
  Environment sky, sunny;
  if (Status s = Environment::from_sky({.elevation_deg = 35}, &sky, {.executor = &executor});
      !s.ok())
    return s;
  Sun sun = sky.sun();
  sun.angular_radius = kSunRadius;
  if (Status s = sky.with_sun(sun, &sunny); !s.ok()) return s;
  return add_light("hard sun", sunny, executor, lights);
}

std::array<float, 9> world_from_eye(const Rendering& rendering) {
  const Frame f = rendering.view.frame();
  return {float(f.x.x), float(f.y.x), float(f.z.x), float(f.x.y), float(f.y.y),
          float(f.z.y), float(f.x.z), float(f.y.z), float(f.z.z)};
}

Status lit_truth(const Rendering& rendering, const Environment& light, int rays, int every,
                 Executor& executor, Image* rgb) {
  ReferenceSettings settings{.occluder = Occluder::solid()};
  settings.falloff = bent_falloff(rendering);
  settings.rays = rays;
  settings.every = every;
  settings.radiance = light_of_rays(light, world_from_eye(rendering));
  *rgb = Image(rendering.view.width, rendering.view.height);
  for (const char* name : {"R", "G", "B"}) rgb->add(name);
  Outputs o;
  o.radiance = {rgb->view(0), rgb->view(1), rgb->view(2)};
  RunOptions options;
  options.executor = &executor;
  return compute(rendering.gbuffer.field(), settings, o, options);
}

Status lit_by(const BentBuffers& b, const Rendering& rendering, const NamedLight& light_source,
              LightingSettings settings, Executor& executor, Image* rgb) {
  LightingInputs in;
  in.visibility = b.visibility;
  in.normal = b.normal;
  in.bent_normal = b.bent;
  in.cone_angle = b.angle;
  settings.world_from_eye = world_from_eye(rendering);
  *rgb = Image(b.image.width, b.image.height);
  for (const char* name : {"R", "G", "B"}) rgb->add(name);
  RunOptions options;
  options.executor = &executor;
  return light(in, light_source.convolved, settings, {rgb->view(0), rgb->view(1), rgb->view(2)},
               options);
}

double rmse(const Image& rgb, const Image& truth, const Rendering& rendering) {
  const DepthInput& g = rendering.gbuffer;
  double sum = 0;
  std::int64_t count = 0;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t i = std::size_t(y) * truth.width + x;
      const std::size_t at = std::size_t(y + g.guard_band.top) * g.width + x + g.guard_band.left;
      if (!std::isfinite(g.depth[at]) || std::isnan(truth.channels[0].values[i])) continue;
      for (int c = 0; c < 3; ++c) {
        const double d = double{rgb.channels[c].values[i]} - truth.channels[c].values[i];
        sum += d * d;
        ++count;
      }
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : NAN;
}

Image tone(const Image& rgb, double white) {
  Image result = rgb;
  for (auto& channel : result.channels) {
    for (float& v : channel.values) {
      const double c = v > 0 ? std::min(v / white, 1.0) : 0;
      v = static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
    }
  }
  return result;
}

}  // namespace obscura::tools
