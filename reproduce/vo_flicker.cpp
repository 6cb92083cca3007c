#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "reproduce/vo_scenes.h"
#include "reproduce/volumetric.h"
#include "scene/scenes/load_scene.h"

namespace obscura::tools {
namespace {

constexpr int kFrames = 60;
constexpr int kPatterns = 24;  // of the converged integral

}  // namespace

// Frame-to-frame change beyond that of the converged integral: e_f is the mean over pixels of
// |(v_f - v_(f-1)) - (c_f - c_(f-1))|.
Status reproduce_vo_flicker(const ReproduceContext& context, Report* report, std::string* text) {
  const std::unique_ptr<Executor> executor = make_executor(context.threads);
  const std::vector<std::string> scenes = {"hall", "meadow"};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    Rendering start;
    ViewOptions options;
    options.size = {320, 180};
    if (Status s = load_scene("scene:" + scenes[k], options, *executor, &start); !s.ok()) return s;
    const float radius = static_cast<float>(0.05 * start.gbuffer.scene_size);
    const std::vector<VoVariant> variants = vo_variants(radius);
    std::vector<std::vector<float>> last(variants.size());
    std::vector<double> change(variants.size()), error(variants.size());
    std::vector<float> last_converged;
    for (int frame = 0; frame < kFrames; ++frame) {
      if (!context.step(scenes[k], (k + double(frame) / kFrames) / scenes.size())) {
        return {StatusCode::kCancelled, "stopped by the caller"};
      }
      // The camera sways sideways by half of the radius, once to and fro.
      ViewSpec view = start.view;
      const double sway = 0.5 * radius * std::sin(2 * std::numbers::pi * frame / kFrames);
      view.eye.x += sway;
      view.look_at.x += sway;
      DepthInput input;
      if (Status s = render_gbuffer(*start.scene, view, {}, *executor, &input); !s.ok()) return s;
      std::vector<float> converged, v;
      if (Status s = vo_converged(input, radius, kPatterns, executor.get(), &converged); !s.ok()) {
        return s;
      }
      for (std::size_t i = 0; i < variants.size(); ++i) {
        if (Status s = vo_visibility(input, variants[i].settings, 1, executor.get(), &v); !s.ok()) {
          return s;
        }
        error[i] += vo_error(input, v, converged) / kFrames;
        std::vector<float> own(v.size()), whole(v.size());
        for (std::size_t p = 0; p < v.size() && frame > 0; ++p) {
          own[p] = v[p] - last[i][p];
          whole[p] = converged[p] - last_converged[p];
        }
        change[i] += vo_error(input, own, whole) / (kFrames - 1);
        last[i] = v;
      }
      last_converged = converged;
    }
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const std::string row = fmt::format("{}, {}", scenes[k], variants[i].name);
      report->add(row, "flicker", change[i], "%");
      report->add(row, "error", error[i], "%");
    }
  }
  *text +=
      "60 frames, the camera swaying sideways by half of the radius, once to and fro; 320x180 "
      "pixels. "
      "Flicker is the mean absolute frame-to-frame change beyond that of the converged integral, "
      "in per cent of full scale.\n";
  return {};
}

}  // namespace obscura::tools
