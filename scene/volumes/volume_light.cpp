#include "scene/volumes/volume_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura::tools {
namespace {

Status bad_light(const std::string& text) {
  return invalid_argument(fmt::format("light is '{}'; it must be {}", text, VolumeLight::kForm));
}

// A list of numbers; all of it must be read.
bool parse_numbers(std::string_view text, std::vector<double>* values) {
  while (true) {
    const std::size_t comma = text.find(',');
    double v;
    if (!parse_number(text.substr(0, comma), &v)) return false;
    values->push_back(v);
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

constexpr float kSky = 0.35f;     // the sky's share of the light of a lit picture
constexpr float kGround = 0.15f;  // light from straight below, the sky's zenith being 1
// A lamp over the right shoulder of who looks: this much right and up for each step ahead.
constexpr float kLampRight = 0.65f, kLampUp = 0.4f;

// The cosine between the normal and the way to a lamp `right` and `up` of the camera; 0 from
// behind.
float headlight(const SurfaceCamera& camera, const SurfacePoint& point, float right, float up) {
  float to_eye[3], length2 = 0;
  for (int a = 0; a < 3; ++a) {
    to_eye[a] = camera.orthographic ? -camera.forward[a] : camera.eye[a] - point.position[a];
    length2 += to_eye[a] * to_eye[a];
  }
  if (!(length2 > 0)) return 0;
  const float distance = std::sqrt(length2);
  float dot = 0;
  for (int a = 0; a < 3; ++a) {
    dot += (to_eye[a] / distance + right * camera.right[a] + up * camera.up[a]) * point.normal[a];
  }
  return std::clamp(dot / std::sqrt(1 + right * right + up * up), 0.0f, 1.0f);
}

// Runs loops in the calling thread, as render_surface has threads of its own.
class InlineExecutor : public Executor {
 public:
  int thread_count() const override { return 1; }
  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    for (int i = 0; i < count; ++i) body(i, 0);
  }
};

}  // namespace

Status parse_volume_light(const std::string& text, VolumeLight* light) {
  VolumeLight result;
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  std::vector<double> v;
  if (text == "lit" || text == "ao" || text == "headlight") {
    result.kind = text == "lit"  ? VolumeLight::kLit
                  : text == "ao" ? VolumeLight::kAmbient
                                 : VolumeLight::kHeadlight;
  } else if (text == "octants:upper") {
    result.kind = VolumeLight::kOctants;
    result.upper = true;
  } else if (name == "octants" && parse_numbers(rest, &v)) {
    result.kind = VolumeLight::kOctants;
    result.octants = 0;
    for (double s : v) {
      if (!(s >= 0 && s <= 7 && s == std::floor(s))) return bad_light(text);
      result.octants |= 1u << int(s);
    }
  } else if (name == "shadow" && parse_numbers(rest, &v)) {
    if (v.size() != 3 || !(std::hypot(v[0], v[1], v[2]) > 0) ||
        !std::isfinite(std::hypot(v[0], v[1], v[2]))) {
      return bad_light(text);
    }
    result.kind = VolumeLight::kShadow;
    result.to_light = {v[0], v[1], v[2]};
  } else if (name == "translucent" && parse_numbers(rest, &v)) {
    if (v.size() != 1 || !(v[0] >= 0 && v[0] <= 1)) return bad_light(text);
    result.kind = VolumeLight::kTranslucent;
    result.alpha = float(v[0]);
  } else {
    return bad_light(text);
  }
  *light = result;
  return {};
}

unsigned octants_to_grid(const VolumeImage& image, unsigned octants) {
  int world[3];
  bool flipped[3];
  for (int a = 0; a < 3; ++a) {
    const Double3& axis = image.axes[a];
    world[a] = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::abs(axis[k]) > std::abs(axis[world[a]])) world[a] = k;
    }
    flipped[a] = axis[world[a]] < 0;
  }
  unsigned result = 0;
  for (int s = 0; s < 8; ++s) {
    unsigned of_world = 0;
    for (int a = 0; a < 3; ++a) {
      if (((s >> a & 1) != 0) != flipped[a]) of_world |= 1u << world[a];
    }
    if (octants >> of_world & 1) result |= 1u << s;
  }
  return result;
}

unsigned upper_octants(const VolumeImage& image) {
  const int axis = image.up[1] > image.up[2] ? 1 : 2;
  unsigned octants = 0;
  for (int s = 0; s < 8; ++s) {
    if (s >> axis & 1) octants |= 1u << s;
  }
  return octants;
}

Status VolumeShading::prepare(const VolumeImage& image, GridView<const float> distance,
                              const VolumeLight& light, const OcclusionSettings& occlusion,
                              const VolumeTruth& truth, const RunOptions& run) {
  if (truth.monte_carlo && !light.has_rays()) {
    return invalid_argument("monte-carlo knows the lights lit, ao and shadow:X,Y,Z only");
  }
  if (Status s = validate_ranges(truth.settings); !s.ok()) return s;
  distance_ = distance;
  light_ = light;
  truth_ = truth;
  const Double3 to_light = image.direction_to_grid(light.to_light);
  const Double3 up = image.direction_to_grid(image.up);
  for (int a = 0; a < 3; ++a) {
    to_light_[a] = float(to_light[a]);
    up_[a] = float(up[a]);
  }
  settings_ = {};
  if (light.kind == VolumeLight::kOctants) {
    settings_.octants = octants_to_grid(image, light.upper ? upper_octants(image) : light.octants);
  }
  if (truth.monte_carlo || light.kind == VolumeLight::kHeadlight) return {};
  OcclusionSettings settings = occlusion;
  settings.alpha = light.kind == VolumeLight::kTranslucent ? light.alpha : 1.0f;
  if (light.kind == VolumeLight::kShadow) {
    return sweep_shadow(distance, to_light_, settings, &field_, run);
  }
  return sweep_occlusion(distance, settings, &field_, run);
}

Status VolumeShading::visibility(int first_row, std::span<const SurfacePoint> points,
                                 std::span<float> light) const {
  InlineExecutor executor;
  RunOptions run;
  run.executor = &executor;
  if (!truth_.monte_carlo) return field_.light(points, settings_, light, run);
  MonteCarloSettings settings = truth_.settings;
  // Blocks of rows differ in their noise.
  settings.seed += static_cast<std::uint32_t>(first_row) * 0x9E3779B9u;
  return light_.kind == VolumeLight::kShadow
             ? hard_shadow(distance_, points, to_light_, settings, light, run)
             : monte_carlo_visibility(distance_, points, settings, light, run);
}

SurfaceShader camera_lamp(const SurfaceCamera& camera) {
  return [&camera](int, std::span<const SurfacePoint> points, std::span<float> light) {
    for (std::size_t i = 0; i < points.size(); ++i) light[i] = headlight(camera, points[i], 0, 0);
    return Status();
  };
}

SurfaceShader VolumeShading::shader(const SurfaceCamera& camera) const {
  if (light_.kind == VolumeLight::kHeadlight) return camera_lamp(camera);
  if (light_.kind == VolumeLight::kLit) {
    return [this, &camera](int first_row, std::span<const SurfacePoint> points,
                           std::span<float> light) {
      if (Status s = visibility(first_row, points, light); !s.ok()) return s;
      for (std::size_t i = 0; i < points.size(); ++i) {
        float above = 0;
        for (int a = 0; a < 3; ++a) above += up_[a] * points[i].normal[a];
        const float sky = kGround + (1 - kGround) * (0.5f + 0.5f * above);
        light[i] *= kSky * sky + (1 - kSky) * headlight(camera, points[i], kLampRight, kLampUp);
      }
      return Status();
    };
  }
  return [this](int first_row, std::span<const SurfacePoint> points, std::span<float> light) {
    return visibility(first_row, points, light);
  };
}

}  // namespace obscura::tools
