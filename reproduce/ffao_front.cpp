#include <algorithm>
#include <filesystem>

#include "fmt/format.h"
#include "io/pictures/plot.h"
#include "reproduce/far_field.h"
#include "reproduce/ffao_scenes.h"

namespace obscura::tools {
namespace {

struct Known {
  FfaoView view;
  std::vector<float> truth;
};

Status load_images(const ReproduceContext& context, Executor& executor, std::vector<Known>* out) {
  for (const std::string& name : ffao_scenes(context.data)) {
    Known& image = out->emplace_back();
    if (Status s = load_ffao_view(name, context.data, {640, 360}, executor, &image.view); !s.ok()) {
      return s;
    }
    if (Status s = trace_depth_field(image.view, kSubset, executor, &image.truth); !s.ok()) {
      return s;
    }
  }
  std::error_code error;
  if (context.data.empty() || !std::filesystem::exists(context.data + "/depth", error)) return {};
  for (const char* name : {"hall", "spheres", "terrain"}) {
    Known& image = out->emplace_back();
    if (Status s = load_ffao_depth(name, context.data, &image.view, &image.truth); !s.ok()) {
      return s;
    }
  }
  return {};
}

// A point of the sweep.
struct Setting {
  std::string name;
  FarFieldSettings settings{.occluder = Occluder::solid()};
  double milliseconds = 0, e_a = 0;  // of processor time; means over the images
  bool best = false;                 // nothing quicker is as close
};

std::vector<Setting> sweep() {
  std::vector<Setting> all;
  auto add = [&](const std::string& more, FarFieldSettings s) {
    all.push_back({fmt::format("{}x{}, B0 {}, step {}{}", s.directions, s.segments, s.interval,
                               SettingText<NearStep>::write(s.near_step), more),
                   s});
  };
  const NearStep steps[] = {NearStep::of(2), NearStep::of(1), NearStep::of(0.5f),
                            NearStep::of(0.25f), NearStep::adaptive()};
  FarFieldSettings s{.occluder = Occluder::solid()};
  for (const int directions : {8, 12, 16, 24, 32}) {
    for (const int segments : {1, 2, 3}) {
      for (const NearStep& step : steps) {
        s.directions = directions;
        s.segments = segments;
        s.near_step = step;
        add("", s);
      }
    }
  }
  for (const int directions : {8, 16}) {
    s = {};
    s.directions = directions;
    for (const NearStep& step : {steps[1], steps[2]}) {
      s.near_step = step;
      for (const int interval : {5, 20}) {
        FarFieldSettings other = s;
        other.interval = interval;
        add("", other);
      }
      FarFieldSettings other = s;
      other.segments = 4;
      add("", other);
      other = s;
      other.line_step = 2;
      add(", every 2nd line", other);
      other = s;
      other.profile = SlabProfile::kSlab;
      add(", slab", other);
    }
  }
  return all;
}

Status measure(const std::vector<Known>& images, Executor& executor, Setting* setting,
               Report* report) {
  for (const Known& image : images) {
    FarFieldSettings settings = setting->settings;
    settings.falloff = image.view.falloff;
    FfaoRun run;
    Comparison c;
    if (Status s = run_ffao(image.view, settings, executor, &run, 1); !s.ok()) return s;
    if (Status s = compare_ffao(image.view, run.visibility, image.truth, &c); !s.ok()) return s;
    report->add(setting->name, image.view.name, c.e_a, "%");
    setting->milliseconds += run.processor_ms / static_cast<double>(images.size());
    setting->e_a += c.e_a / static_cast<double>(images.size());
  }
  report->add(setting->name, "mean", setting->e_a, "%");
  report->add(setting->name, "processor time", setting->milliseconds, "ms");
  return {};
}

}  // namespace

Status reproduce_ffao_front(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  std::vector<Known> images;
  if (!context.step("truths", 0)) return stopped();
  if (Status s = load_images(context, *executor, &images); !s.ok()) return s;
  std::vector<Setting> all = sweep();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(all.size());
    if (!context.step(all[i].name, done)) return stopped();
    if (Status s = measure(images, *executor, &all[i], report); !s.ok()) return s;
  }
  std::sort(all.begin(), all.end(),
            [](const Setting& a, const Setting& b) { return a.milliseconds < b.milliseconds; });
  Plot plot{"Far field: settings, mean of the images", "ms of one thread", "e_A, %", {}};
  plot.series = {{"settings", {}, false}, {"front", {}, true}};
  *text =
      "640x360, means of the images; time is that of all threads together. The front, where "
      "nothing quicker is as close:\n\n";
  double least = 1e9;
  for (Setting& s : all) {
    s.best = s.e_a < least;
    least = std::min(least, s.e_a);
    plot.series[s.best].points.emplace_back(s.milliseconds, s.e_a);
    if (s.best) *text += fmt::format("- {}: {:.0f} ms, {:.2f} %\n", s.name, s.milliseconds, s.e_a);
  }
  return context.plot("front", plot.to_svg());
}

}  // namespace obscura::tools
