#include <iterator>
#include <utility>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "reproduce/far_field.h"
#include "reproduce/ffao_scenes.h"

namespace obscura::tools {
Status reproduce_ffao_fig7(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  const std::vector<std::string> scenes = ffao_scenes(context.data);
  double done = 0;
  for (const std::string& scene : scenes) {
    FfaoView view;
    if (Status s = load_ffao_view(scene, context.data, {640, 360}, *executor, &view); !s.ok()) {
      return s;
    }
    if (!context.step(scene + ": truth", done)) return stopped();
    std::vector<float> truth;
    if (Status s = trace_depth_field(view, kEverywhere, *executor, &truth); !s.ok()) return s;
    const ImageView<const float> truth_image(truth.data(), view.width, view.height);
    const std::pair<const char*, MethodSettings> methods[] = {
        {"as in the paper 8x2", far_field_of_the_paper(view, 8)},
        {"as in the paper 16x2", far_field_of_the_paper(view, 16)},
        {"adaptive chord 8x2", far_field_for(view, 8, 2)},
        {"adaptive chord 16x2", far_field_for(view, 16, 2)},
        {"mipmap 16", mipmap_for(view, 16)}};
    std::vector<Image> rows;
    for (const auto& [name, settings] : methods) {
      done += 1.0 / static_cast<double>(scenes.size() * std::size(methods));
      if (!context.step(fmt::format("{}: {}", scene, name), done)) return stopped();
      FfaoRun run;
      Comparison c;
      if (Status s = run_ffao(view, settings, *executor, &run); !s.ok()) return s;
      if (Status s = compare_ffao(view, run.visibility, truth, &c); !s.ok()) return s;
      const std::string row = fmt::format("{}, {}", scene, name);
      report->add(row, "e_A", c.e_a, "%");
      report->add(row, "e_<5%", c.within_5, "%");
      report->add(row, "bias", c.bias, "%");
      report->add(row, "time", run.milliseconds, "ms");
      const ImageView<const float> image(run.visibility.data(), view.width, view.height);
      rows.push_back(
          beside({{name, grey_picture(image)}, {"error", error_picture(image, truth_image)}}));
    }
    if (Status s = context.picture(scene, stack(rows)); !s.ok()) return s;
  }
  *text = fmt::format(
      "Truth: the solid depth field, {} rays. 640x360 with a guard band of 10 %, exponential "
      "falloff "
      "of 10 % (meadow: 4 %) of the scene's size. Error pictures are white at 0 % and black from "
      "20 % on.\n",
      kEverywhere.rays);
  return {};
}

}  // namespace obscura::tools
