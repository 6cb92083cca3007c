#include <utility>

#include "fmt/format.h"
#include "reproduce/far_field.h"
#include "reproduce/ffao_scenes.h"

namespace obscura::tools {
namespace {

constexpr ImageSize kSizes[] = {{1280, 720}, {1920, 1080}};

std::string name_of(ImageSize size) { return fmt::format("{}x{}", size.width, size.height); }

// The paper's second scene, and the kitchen where it is there.
std::vector<std::string> timed_scenes(const std::string& data) {
  std::vector<std::string> names = ffao_scenes(data);
  names.erase(names.begin());
  return names;
}

// Calls body(view, size's name) for every timed scene and size.
template <class Body>
Status for_views(const ReproduceContext& context, Executor& executor, const Body& body) {
  const std::vector<std::string> scenes = timed_scenes(context.data);
  double done = 0;
  for (const std::string& scene : scenes) {
    for (const ImageSize size : kSizes) {
      if (!context.step(scene + " " + name_of(size), done)) return stopped();
      done += (size.height > 720 ? 0.7 : 0.3) / static_cast<double>(scenes.size());
      FfaoView view;
      if (Status s = load_ffao_view(scene, context.data, size, executor, &view); !s.ok()) return s;
      if (Status s = body(view, name_of(size)); !s.ok()) return s;
    }
  }
  return {};
}

}  // namespace

Status reproduce_ffao_table1(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  *text = "The paper's times are for its far field on a Radeon 7970.\n";
  return for_views(context, *executor, [&](const FfaoView& view, const std::string& size) {
    FfaoRun run;
    for (const int directions : {8, 16}) {
      for (const bool near : {false, true}) {
        FarFieldSettings settings = far_field_for(view, directions, 2);
        settings.near_field = near;
        settings.near_step = NearStep::of(1);
        if (Status s = run_ffao(view, settings, *executor, &run); !s.ok()) return s;
        report->add(fmt::format("{}: {}, K = {}x2", view.name,
                                near ? "with near field" : "far field alone", directions),
                    size, run.milliseconds, "ms");
      }
    }
    if (Status s = run_ffao(view, mipmap_for(view, 16), *executor, &run); !s.ok()) return s;
    report->add(view.name + ": mipmap, K = 16, near field included", size, run.milliseconds, "ms");
    return Status();
  });
}

Status reproduce_ffao_table2(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  *text =
      "K = 8x2, B0 = 10, near step 1 px. The paper's phases are scan, sum and far field; it does "
      "not "
      "time the others. The near field is what the evaluation takes longer with it than without.\n";
  return for_views(context, *executor, [&](const FfaoView& view, const std::string& size) {
    FarFieldSettings settings = far_field_for(view, 8, 2);
    settings.near_step = NearStep::of(1);
    FfaoRun both, far;
    if (Status s = run_ffao(view, settings, *executor, &both); !s.ok()) return s;
    settings.near_field = false;
    if (Status s = run_ffao(view, settings, *executor, &far); !s.ok()) return s;
    auto add = [&](const char* name, double ms) {
      report->add(fmt::format("{}: {}", view.name, name), size, ms, "ms");
    };
    add("convert the input", both.pass("convert"));
    add("fill two orientations", both.pass("fill"));
    add("scan", both.pass("scan"));
    add("sum", both.pass("sum"));
    add("far field", far.pass("evaluate"));
    add("near field", both.pass("evaluate") - far.pass("evaluate"));
    add("collect and write", both.pass("collect") + both.pass("write") + both.pass("background"));
    add("total", both.milliseconds);
    return Status();
  });
}

Status reproduce_ffao_table3(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  *text = "1280x720, K = 8x2, far field alone.\n";
  for (const std::string& scene : timed_scenes(context.data)) {
    FfaoView view;
    if (Status s = load_ffao_view(scene, context.data, kSizes[0], *executor, &view); !s.ok()) {
      return s;
    }
    for (const int interval : {20, 10, 5}) {
      const std::string row = fmt::format("{}: B0 = {}", scene, interval);
      if (!context.step(row, (20 - interval) / 20.0)) return stopped();
      FarFieldSettings settings = far_field_for(view, 8, 2);
      settings.interval = interval;
      settings.near_field = false;
      FfaoRun run;
      if (Status s = run_ffao(view, settings, *executor, &run); !s.ok()) return s;
      report->add(row, "time", run.milliseconds, "ms");
    }
  }
  return {};
}

namespace {

// K = 18x2 in full and shared out over 3x3 pixels; 16x2 over 2x2.
std::vector<std::pair<std::string, FarFieldSettings>> separable_variants(const FfaoView& view) {
  FarFieldSettings full = far_field_for(view, 18, 2), three = full;
  full.near_step = three.near_step = NearStep::of(1);
  three.separable = 3;
  FarFieldSettings two = three;
  two.directions = 16;
  two.separable = 2;
  return {{"full", full}, {"3x3", three}, {"16x2, 2x2", two}};
}

Status separable_errors(const ReproduceContext& context, Executor& executor, Report* report) {
  for (const std::string& scene : ffao_scenes(context.data)) {
    if (!context.step(scene + ": errors", 0.9)) return stopped();
    FfaoView view;
    if (Status s = load_ffao_view(scene, context.data, {640, 360}, executor, &view); !s.ok()) {
      return s;
    }
    std::vector<float> truth;
    if (Status s = trace_depth_field(view, kSubset, executor, &truth); !s.ok()) return s;
    for (const auto& [name, settings] : separable_variants(view)) {
      FfaoRun run;
      Comparison c;
      if (Status s = run_ffao(view, settings, executor, &run); !s.ok()) return s;
      if (Status s = compare_ffao(view, run.visibility, truth, &c); !s.ok()) return s;
      report->add(fmt::format("{}: {}", scene, name), "e_A at 640x360", c.e_a, "%");
    }
  }
  return {};
}

}  // namespace

Status reproduce_ffao_table4(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  *text =
      "K = 18x2, B0 = 10, near step 1 px; groups of pixels share the directions out, near and far "
      "field alike; the paper's table leaves the near field out and keeps it whole.\n";
  const Status timed =
      for_views(context, *executor, [&](const FfaoView& view, const std::string& size) {
        FfaoRun run, alone;
        for (auto [name, settings] : separable_variants(view)) {
          if (Status s = run_ffao(view, settings, *executor, &run); !s.ok()) return s;
          settings.near_field = false;
          if (Status s = run_ffao(view, settings, *executor, &alone); !s.ok()) return s;
          const std::string row = fmt::format("{}: {}", view.name, name);
          auto add = [&](const char* what, double ms) {
            report->add(row, fmt::format("{} {}", what, size), ms, "ms");
          };
          add("scan", alone.pass("scan"));
          add("sum", alone.pass("sum"));
          add("share", alone.pass("share"));
          add("far field", alone.pass("evaluate"));
          add("gather", alone.pass("gather"));
          add("far field, total", alone.milliseconds);
          add("near field", run.pass("evaluate") - alone.pass("evaluate"));
          add("total", run.milliseconds);
        }
        return Status();
      });
  return timed.ok() ? separable_errors(context, *executor, report) : timed;
}

}  // namespace obscura::tools
