#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/pictures/plot.h"
#include "obscura/estimator.h"
#include "reproduce/temporal.h"
#include "scene/rays/gbuffer.h"
#include "scene/scenes/load_scene.h"

namespace obscura::tools {
namespace {

constexpr int kFrames = 60;
constexpr ImageSize kSize{320, 180};
constexpr double kOfMean = 1.0 / 8;  // what a new frame counts in the exponential mean
constexpr double kSameDepth = 0.01;  // of the depth: the same surface in both frames

struct View {
  ViewSpec spec;
  DepthInput input;
};

// Where each visible pixel's surface point lay in the frame before: four pixels and their weights.
// No pixel where it was hidden, outside, or there is none.
struct Source {
  std::array<int, 4> pixels{-1, -1, -1, -1};
  std::array<float, 4> weights{};
};

std::vector<Source> sources(const View& now, const View& before) {
  const Camera &c = now.input.camera, &b = before.input.camera;
  const GuardBand& g = now.input.guard_band;
  const Frame f = now.spec.frame(), fb = before.spec.frame();
  std::vector<Source> list(std::size_t(kSize.width) * kSize.height);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const int u = x + g.left, v = y + g.top;
      const double d = now.input.depth[std::size_t(v) * now.input.width + u];
      if (!(d < 1e10)) continue;
      const Vec3 world = now.spec.eye + f.x * ((u + 0.5 - c.center_u) * c.scale_x * d) +
                         f.y * ((c.center_v - v - 0.5) * c.scale_y * d) - f.z * d;
      const Vec3 to = world - before.spec.eye;
      const double depth = -dot(to, fb.z);
      if (depth <= 0) continue;
      const double px = dot(to, fb.x) / (b.scale_x * depth) + b.center_u - 0.5;
      const double py = b.center_v - dot(to, fb.y) / (b.scale_y * depth) - 0.5;
      const int x0 = int(std::floor(px)), y0 = int(std::floor(py));
      const float wx = float(px - x0), wy = float(py - y0);
      Source source;
      for (int k = 0; k < 4; ++k) {
        const int qx = x0 + k % 2, qy = y0 + k / 2;
        const int vx = qx - g.left, vy = qy - g.top;
        if (vx < 0 || vy < 0 || vx >= kSize.width || vy >= kSize.height) break;
        const double there = before.input.depth[std::size_t(qy) * before.input.width + qx];
        if (!(std::abs(there - depth) <= kSameDepth * depth)) break;
        source.pixels[std::size_t(k)] = vy * kSize.width + vx;
        source.weights[std::size_t(k)] = (k % 2 ? wx : 1 - wx) * (k / 2 ? wy : 1 - wy);
      }
      // All four show the surface, or the pixel does not count.
      if (source.pixels[3] >= 0) {
        list[std::size_t(y) * kSize.width + x] = source;
      }
    }
  }
  return list;
}

float at(const std::vector<float>& image, const Source& s) {
  float sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += s.weights[k] * image[std::size_t(s.pixels[k])];
  return sum;
}

// A method's picture over the frames, and its exponential mean along the surface.
struct Track {
  std::vector<float> last, mean;
  double change = 0, change_of_mean = 0;  // sums over the frames of means over pixels
};

void add_frame(const std::vector<float>& now, const std::vector<Source>& from, int frame,
               Track* t) {
  if (frame == 0) {
    t->last = t->mean = now;
    return;
  }
  std::vector<float> mean = now;  // where there is no history
  double change = 0, change_of_mean = 0;
  int count = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    if (from[p].pixels[0] < 0) continue;
    const float history = at(t->mean, from[p]);
    mean[p] = history + float(kOfMean) * (now[p] - history);
    change += std::abs(now[p] - at(t->last, from[p]));
    change_of_mean += std::abs(mean[p] - history);
    ++count;
  }
  if (count > 0) {
    t->change += change / count;
    t->change_of_mean += change_of_mean / count;
  }
  t->last = now;
  t->mean = std::move(mean);
}

// The methods at their defaults with a radius of the scene's; with a new seed per frame where they
// have one.
struct Candidate {
  std::string name;
  MethodSettings settings;
  bool new_seed = false;
};

std::vector<Candidate> candidates(float radius) {
  std::vector<Candidate> list;
  for_each_method([&](auto info, auto settings) {
    if (std::string_view(info.name) == MethodInfo<ReferenceSettings>::name) return;
    settings.falloff.radius = radius;
    list.push_back({info.name, settings, false});
    if constexpr (requires { settings.seed; }) {
      list.push_back({info.name + std::string(", new seed"), settings, true});
    }
  });
  return list;
}

MethodSettings of_frame(const Candidate& c, int frame) {
  MethodSettings settings = c.settings;
  if (!c.new_seed) return settings;
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.seed; }) s.seed += std::uint32_t(frame);
      },
      settings);
  return settings;
}

}  // namespace

// At a point of a surface that does not move, the truth does not change when the camera does. All
// that changes along the surface is the method's own: change is the mean over pixels of
// |v_f - v_(f-1)| with v_(f-1) read where the point lay in the frame before.
Status reproduce_temporal(const ReproduceContext& context, Report* report, std::string* text) {
  const std::unique_ptr<Executor> executor = make_executor(context.threads);
  const std::vector<std::string> scenes = {"hall", "meadow", "tower"};
  Plot plot;  // of the fixed patterns
  plot.title = "Change along the surface, a point per scene";
  plot.x_label = "change from frame to frame, %";
  plot.y_label = "change of the mean, %";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    Rendering start;
    ViewOptions options;
    options.size = kSize;
    if (Status s = load_scene("scene:" + scenes[k], options, *executor, &start); !s.ok()) return s;
    const double radius = 0.05 * start.gbuffer.scene_size;
    const std::vector<Candidate> all = candidates(float(radius));
    std::vector<Track> tracks(all.size());
    View before;
    for (int frame = 0; frame < kFrames; ++frame) {
      if (!context.step(scenes[k], (double(k) + double(frame) / kFrames) / double(scenes.size()))) {
        return {StatusCode::kCancelled, "stopped by the caller"};
      }
      // The camera sways sideways by half of the radius, once to and fro.
      View now{start.view, {}};
      const double sway = 0.5 * radius * std::sin(2 * std::numbers::pi * frame / kFrames);
      now.spec.eye.x += sway;
      now.spec.look_at.x += sway;
      if (Status s = render_gbuffer(*start.scene, now.spec, {}, *executor, &now.input); !s.ok()) {
        return s;
      }
      const std::vector<Source> from = frame > 0 ? sources(now, before) : std::vector<Source>();
      for (std::size_t i = 0; i < all.size(); ++i) {
        std::vector<float> v(std::size_t(kSize.width) * kSize.height);
        Outputs outputs;
        outputs.visibility = {v.data(), kSize.width, kSize.height};
        RunOptions run;
        run.executor = executor.get();
        if (Status s = compute(now.input.field(), of_frame(all[i], frame), outputs, run); !s.ok()) {
          return s;
        }
        add_frame(v, from, frame, &tracks[i]);
      }
      before = std::move(now);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string row = fmt::format("{}, {}", scenes[k], all[i].name);
      const double change = 100 * tracks[i].change / (kFrames - 1);
      const double of_mean = 100 * tracks[i].change_of_mean / (kFrames - 1);
      report->add(row, "change", change, "%");
      report->add(row, "change of the mean", of_mean, "%");
      if (all[i].new_seed) continue;
      if (k == 0) plot.series.push_back({all[i].name, {}, false});
      const auto series = std::find_if(plot.series.begin(), plot.series.end(),
                                       [&](const auto& one) { return one.name == all[i].name; });
      series->points.emplace_back(change, of_mean);
    }
  }
  if (Status s = context.plot("methods", plot.to_svg()); !s.ok()) return s;
  *text +=
      "60 frames of 320x180, the camera swaying sideways by half of the radius (5 % of the scene), "
      "once to and fro. Change is the mean over pixels of |v_f - v_(f-1)| at the same points of "
      "the "
      "surface, in per cent of full scale; the truth's is 0, as nothing moves but the camera. The "
      "mean is exponential, a new frame counts one eighth, along the surface. Methods with a seed "
      "also ran with a new one in each frame.\n";
  return {};
}

}  // namespace obscura::tools
