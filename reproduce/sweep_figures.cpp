// Figures 4 to 10 of fast occlusion sweeping, each on a volume that stands for the paper's own,
// which is not public.
#include <cmath>
#include <memory>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "reproduce/sweeps.h"
#include "scene/volumes/load_volume.h"
#include "scene/volumes/volume_light.h"
#include "scene/volumes/volume_picture.h"
#include "scene/volumes/volume_view.h"

namespace obscura::tools {
namespace {

constexpr int kSide = 300, kRays = 256;
constexpr float kPaperGamma = 2;

// What a panel shows: a light, how it is found, and the gamma of the picture.
struct FigurePanel {
  const char* title;
  const char* light;  // as obscura volume --light has it
  float gamma = 1;
  bool rays = false;
  bool geometry_term = true;
};
struct Figure {
  int number;
  const char* spec;
  const char* stands_for;
  std::vector<FigurePanel> panels;
};

std::vector<Figure> figures() {
  return {
      {4,
       "volume:cloud?size=160",
       "vorticity in a lightning cloud",
       {{"local light", "headlight"},
        {"ambient visibility", "ao"},
        {"with gamma 2", "ao", kPaperGamma},
        {"256 rays, gamma 2", "ao", kPaperGamma, true}}},
      {5,
       "volume:vessels?size=256",
       "capillaries of a mouse brain",
       {{"local light", "headlight"},
        {"ambient visibility", "ao"},
        {"with gamma 2", "ao", kPaperGamma},
        {"obscura's default", "lit", kPaperGamma}}},
      {6,
       "volume:gyroid?size=160",
       "the capillaries, near",
       {{"with geometry term", "ao"},
        {"without", "ao", 1, false, false},
        {"with, gamma 2", "ao", kPaperGamma},
        {"without, gamma 2", "ao", kPaperGamma, false, false}}},
      {7,
       "volume:pillars?size=160",
       "a surface under a cloudy sky",
       {{"all octants", "ao"},
        {"upper four", "octants:upper"},
        {"upper four, gamma 2", "octants:upper", kPaperGamma}}},
      {8,
       "volume:sphere-over-plane?size=128",
       "a simple data set",
       {{"hard shadow by rays", "shadow:1,1,1", 1, true}, {"one octant swept", "shadow:1,1,1"}}},
      {9,
       "volume:vessels?size=256",
       "the capillaries of Figure 5",
       {{"hard shadow by rays", "shadow:1,1,1", 1, true}, {"one octant swept", "shadow:1,1,1"}}},
      {10,
       "volume:cloud?size=160",
       "a surface that scatters light forwards",
       {{"alpha 1", "translucent:1"},
        {"0.5", "translucent:0.5"},
        {"0.25", "translucent:0.25"},
        {"0.1", "translucent:0.1"}}},
  };
}

// Light and coverage of a panel, a channel each.
struct PanelImages {
  Image light{kSide, kSide}, coverage{kSide, kSide};
};

Status render_panel(const VolumeImage& image, GridView<const float> distance,
                    const SurfaceCamera& camera, const FigurePanel& panel, const RunOptions& run,
                    PanelImages* images) {
  VolumeLight light;
  if (Status s = parse_volume_light(panel.light, &light); !s.ok()) return s;
  VolumeTruth truth;
  truth.monte_carlo = panel.rays;
  truth.settings.rays = light.kind == VolumeLight::kShadow ? 1 : kRays;
  VolumeShading shading;
  if (Status s = shading.prepare(image, distance, light, {}, truth, run); !s.ok()) return s;
  SurfaceShader shader = shading.shader(camera);
  if (!panel.geometry_term) {
    shader = [&shading](int, std::span<const SurfacePoint> points, std::span<float> values) {
      return shading.field().light(points, {.geometry_term = false}, values, {.threads = 1});
    };
  }
  images->light.add("Y");
  images->coverage.add("Y");
  return render_surface({image.view(), image.isovalue.value_or(0), SolidSide::kAbove, distance},
                        camera, {}, shader, {images->light.view(0), images->coverage.view(0)}, run);
}

// Over the pixels that the surface covers wholly.
struct Difference {
  double mean = 0, rmse = 0;
};
Difference difference(const PanelImages& a, const PanelImages& b) {
  Difference d;
  double count = 0;
  for (std::size_t i = 0; i < a.coverage.channels[0].values.size(); ++i) {
    if (a.coverage.channels[0].values[i] < 1) continue;
    const double e = a.light.channels[0].values[i] - b.light.channels[0].values[i];
    d.mean += e;
    d.rmse += e * e;
    ++count;
  }
  return {d.mean / count, std::sqrt(d.rmse / count)};
}

Status make_figure(const ReproduceContext& context, const Figure& figure, const RunOptions& run,
                   Report* report) {
  VolumeImage image;
  if (Status s = load_volume(figure.spec, {}, &image, context.threads); !s.ok()) return s;
  std::vector<float> values(std::size_t(image.voxels()));
  const GridView<float> distance(values.data(), image.size, image.view().spacing);
  if (Status s = sweep_distance(image.view(), {}, distance, run); !s.ok()) return s;
  VolumeViewOptions options;
  options.size = {kSide, kSide};
  SurfaceCamera camera;
  if (Status s = place_camera(image, distance, options, &camera, run); !s.ok()) return s;
  std::vector<PanelImages> images(figure.panels.size());
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const FigurePanel& panel = figure.panels[i];
    if (Status s = render_panel(image, distance, camera, panel, run, &images[i]); !s.ok()) return s;
    PictureColours colours;
    if (std::string_view(panel.light) != "lit") colours.surface = {1, 1, 1};
    panels.push_back(
        {panel.title, picture_of_light(images[i].light, images[i].coverage, colours, panel.gamma)});
    // A gamma does not change the light.
    if (i == 0 || (panel.gamma != 1 && panel.rays == figure.panels[0].rays)) continue;
    const Difference d = difference(images[i], images[0]);
    const std::string entry =
        fmt::format("Figure {}: {} less {}", figure.number, panel.title, panels[0].title);
    report->add(entry, "mean of light", d.mean);
    report->add(entry, "RMSE of light", d.rmse);
  }
  if (figure.number == 4) {
    const Difference d = difference(images[1], images[3]);
    report->add("Figure 4: sweep less rays", "mean of light", d.mean);
    report->add("Figure 4: sweep less rays", "RMSE of light", d.rmse);
  }
  return context.picture(fmt::format("{}", figure.number), beside(panels));
}

}  // namespace

Status reproduce_sweep_figures(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  RunOptions run;
  run.executor = executor.get();
  const std::vector<Figure> all = figures();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!context.step(fmt::format("Figure {}", all[i].number), double(i) / double(all.size()))) {
      return {StatusCode::kCancelled, "cancelled by the caller"};
    }
    if (Status s = make_figure(context, all[i], run, report); !s.ok()) return s;
    *text += fmt::format("Figure {}: {} stands for {}.\n\n", all[i].number, all[i].spec,
                         all[i].stands_for);
  }
  return {};
}

}  // namespace obscura::tools
