// Error of each transport against Monte Carlo through the same field, with pictures.
#include <cmath>
#include <filesystem>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "reproduce/sweep_scene.h"
#include "reproduce/sweeps.h"

namespace obscura::tools {
namespace {

constexpr int kSide = 100;     // voxels of the procedural volumes
constexpr int kPicture = 160;  // pixels
constexpr int kRays = 1024;

struct Case {
  std::string name;
  SweepSource source;
  bool in_mean = true;
};
Case procedural(const char* name, int side) {
  return {name, {fmt::format("volume:{}?size={}", name, side)}};
}

// The eight volumes that the mean is over, as far as they are there, and others that nothing was
// tuned on.
std::vector<Case> cases(const std::string& data) {
  std::vector<Case> list;
  for (const char* name : {"sphere-over-plane", "pillars", "cup", "open-box", "gyroid"}) {
    list.push_back(procedural(name, kSide));
  }
  for (const char* name : {"MR", "engine", "bonsai"}) {
    const std::string file = fmt::format("{}/volumes/{}.nii.gz", data, name);
    if (!data.empty() && std::filesystem::exists(file)) list.push_back({name, {file}});
  }
  auto further = [&](Case c, const char* what) {
    c.name += what;
    c.in_mean = false;
    list.push_back(c);
    return &list.back().source;
  };
  further(procedural("sphere-over-plane", 50), ", 50^3");
  further(procedural("sphere-over-plane", 200), ", 200^3");
  further(procedural("vessels", 128), "");
  further(procedural("cloud", 128), "");
  further(procedural("gyroid", 128), ", 128^3, other isovalue")->offset = 0.02f;
  further(procedural("pillars", 150), ", spacing 1:1:2")->every = 2;
  further(procedural("cup", 150), ", spacing 1:1:3")->every = 3;
  return list;
}

struct Figures {
  double rmse = 0, bias = 0, correlation = 0;
};
Figures compare(const std::vector<float>& a, const std::vector<float>& b) {
  const double n = double(a.size());
  double ab = 0, aa = 0, bb = 0, ma = 0, mb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  Figures f;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    f.rmse += (a[i] - b[i]) * (a[i] - b[i]) / n;
  }
  f.rmse = std::sqrt(f.rmse);
  f.bias = ma - mb;
  f.correlation = ab / std::sqrt(std::max(1e-30, aa * bb));
  return f;
}

}  // namespace

Status reproduce_sweep_error(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  RunOptions run;
  run.executor = executor.get();
  const std::vector<Case> volumes = cases(context.data);
  constexpr Transport kTransports[] = {Transport::kPaper, Transport::kFast, Transport::kBalanced,
                                       Transport::kAccurate};
  Figures mean[std::size(kTransports)];
  double count = 0;
  for (const Case& c : volumes) count += c.in_mean;
  std::vector<Image> rows;
  auto report_mean = [&] {
    for (std::size_t t = 0; t < std::size(kTransports); ++t) {
      const std::string transport = enum_name(kTransports[t]);
      report->add("mean", transport + " RMSE", mean[t].rmse);
      report->add("mean", transport + " bias", mean[t].bias);
      report->add("mean", transport + " correlation", mean[t].correlation);
    }
  };
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const auto& [name, source, in_mean] = volumes[i];
    if (i > 0 && volumes[i - 1].in_mean && !in_mean) report_mean();
    if (!context.step(name, double(i) / double(volumes.size()))) {
      return {StatusCode::kCancelled, "stopped"};
    }
    SweepScene scene;
    if (Status s = load_sweep_scene(source, kPicture, run, &scene); !s.ok()) return s;
    std::vector<float> truth(scene.points.size()), light(scene.points.size());
    MonteCarloSettings mc;
    mc.rays = kRays;
    if (Status s = monte_carlo_visibility(scene.grid(), scene.points, mc, truth, run); !s.ok()) {
      return s;
    }
    std::vector<Panel> panels = {{name + ": rays", scene.picture(truth)}};
    for (std::size_t t = 0; t < std::size(kTransports); ++t) {
      OcclusionSettings settings;
      settings.transport = kTransports[t];
      VisibilityField field;
      if (Status s = sweep_occlusion(scene.grid(), settings, &field, run); !s.ok()) return s;
      if (Status s = field.light(scene.points, {}, light, run); !s.ok()) return s;
      const Figures f = compare(light, truth);
      const std::string transport = enum_name(settings.transport);
      report->add(name, transport + " RMSE", f.rmse);
      report->add(name, transport + " bias", f.bias);
      report->add(name, transport + " correlation", f.correlation);
      const double share = in_mean ? 1 / count : 0;
      mean[t].rmse += f.rmse * share;
      mean[t].bias += f.bias * share;
      mean[t].correlation += f.correlation * share;
      panels.push_back({transport, scene.picture(light)});
    }
    if (in_mean) rows.push_back(beside(panels));
  }
  *text = fmt::format(
      "Linear visibility against {} rays per pixel through the same distance field, over the\n"
      "pixels of an orthographic view of {}x{} that hit the surface. Isovalues of files are\n"
      "Otsu's. The mean is that of the volumes in the picture; those below it have other sizes,\n"
      "isovalues and spacings.{}\n",
      kRays, kPicture, kPicture,
      count == 5 ? " The three scanned volumes were not found: name their folder by --data." : "");
  return context.picture("pictures", stack(rows));
}

// Figure 3: the sweeps beside Monte Carlo, as they are and with the paper's gamma of 2.
Status reproduce_sweep_fig3(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  RunOptions run;
  run.executor = executor.get();
  SweepScene scene;
  const std::string spec = fmt::format("volume:pillars?size={}", kSide);
  if (Status s = load_sweep_scene({spec}, 2 * kPicture, run, &scene); !s.ok()) return s;
  const std::size_t n = scene.points.size();
  std::vector<float> truth(n), paper(n), balanced(n), local(n);
  context.step("Monte Carlo", 0);
  if (Status s = monte_carlo_visibility(scene.grid(), scene.points, {}, truth, run); !s.ok()) {
    return s;
  }
  for (auto [transport, out] :
       {std::pair(Transport::kPaper, &paper), std::pair(Transport::kBalanced, &balanced)}) {
    OcclusionSettings settings;
    settings.transport = transport;
    VisibilityField field;
    if (Status s = sweep_occlusion(scene.grid(), settings, &field, run); !s.ok()) return s;
    if (Status s = field.light(scene.points, {}, *out, run); !s.ok()) return s;
  }
  for (std::size_t i = 0; i < n; ++i) {  // headlight
    float cosine = 0;
    for (int a = 0; a < 3; ++a) cosine -= scene.points[i].normal[a] * scene.view[a];
    local[i] = std::max(cosine, 0.0f);
  }
  report->add("paper", "RMSE", compare(paper, truth).rmse);
  report->add("balanced", "RMSE", compare(balanced, truth).rmse);
  auto gamma = [](std::vector<float> v) {
    for (float& x : v) x = std::sqrt(x);
    return v;
  };
  report->add("paper, gamma 2", "RMSE", compare(gamma(paper), gamma(truth)).rmse);
  report->add("balanced, gamma 2", "RMSE", compare(gamma(balanced), gamma(truth)).rmse);
  const Image linear = beside({{"local illumination", scene.picture(local)},
                               {"paper's transport", scene.picture(paper)},
                               {"balanced", scene.picture(balanced)},
                               {"Monte Carlo", scene.picture(truth)}});
  const Image raised = beside({{"", scene.picture(gamma(local))},
                               {"gamma 2", scene.picture(gamma(paper))},
                               {"gamma 2", scene.picture(gamma(balanced))},
                               {"gamma 2", scene.picture(gamma(truth))}});
  *text =
      "Pillars on a plane, 100^3 voxels; above linear visibility, below with the paper's gamma of\n"
      "2, which hides part of the paper's darkening.\n";
  return context.picture("pictures", stack({linear, raised}));
}

}  // namespace obscura::tools
