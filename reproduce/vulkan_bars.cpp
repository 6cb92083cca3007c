#include <algorithm>
#include <limits>

#include "device/headless.h"
#include "fmt/format.h"
#include "reproduce/ffao_scenes.h"
#include "reproduce/vulkan_times.h"

namespace obscura::tools {
namespace {

struct Point {
  double milliseconds = 0, e_a = 0;
};
Status measure(HeadlessVulkan& vulkan, const FfaoView& view, const std::vector<float>& truth,
               const MethodSettings& settings, Point* point) {
  std::vector<float> v(static_cast<std::size_t>(view.width) * view.height);
  HeadlessTimes times;
  const Outputs outputs{.visibility = {v.data(), view.width, view.height}};
  if (Status s = vulkan.run(view.rendering.gbuffer.field(), settings, outputs, &times, {}, 3);
      !s.ok()) {
    return s;
  }
  Comparison c;
  if (Status s = compare_ffao(view, v, truth, &c); !s.ok()) return s;
  *point = {times.total_ms(), c.e_a};
  return {};
}

}  // namespace

Status reproduce_vulkan_bars(const ReproduceContext& context, Report* report, std::string* text) {
  HeadlessVulkan vulkan;
  if (Status s = HeadlessVulkan::create({}, &vulkan); !s.ok()) return s;
  *text += fmt::format(
      "On {}, 640x360 with a guard band of 10 %; against mipmap with the K, 4 to 64, that errs "
      "least "
      "of those that take at most 5 % longer.\n",
      vulkan.info().name);
  const auto executor = make_executor(context.threads);
  double done = 0;
  for (const char* scene : {"hall", "meadow"}) {
    FfaoView view;
    std::vector<float> truth;
    if (!context.step(scene, done)) return stopped();
    done += 0.5;
    if (Status s = load_ffao_view(scene, context.data, {640, 360}, *executor, &view); !s.ok()) {
      return s;
    }
    if (Status s = trace_depth_field(view, kSubset, *executor, &truth); !s.ok()) return s;
    std::vector<Point> mipmaps;
    for (const int k : {4, 6, 8, 12, 16, 24, 32, 48, 64}) {
      if (Status s = measure(vulkan, view, truth, mipmap_for(view, k), &mipmaps.emplace_back());
          !s.ok()) {
        return s;
      }
    }
    for (const auto preset :
         {FarFieldPreset::kFast, FarFieldPreset::kBalanced, FarFieldPreset::kHigh}) {
      Point ours;
      if (Status s = measure(vulkan, view, truth, far_field_for(view, preset), &ours); !s.ok()) {
        return s;
      }
      double least = std::numeric_limits<double>::infinity();
      for (const Point& p : mipmaps) {
        if (p.milliseconds <= 1.05 * ours.milliseconds) least = std::min(least, p.e_a);
      }
      const std::string row = fmt::format("{}, {}", scene, write_setting(preset));
      report->add(row, "device", ours.milliseconds, "ms");
      report->add(row, "e_A", ours.e_a, "%");
      report->add(row, "mipmap's e_A", least, "%");
      report->add(row, "ratio", ours.e_a / least, "", 0.5);
    }
  }
  return {};
}

}  // namespace obscura::tools
