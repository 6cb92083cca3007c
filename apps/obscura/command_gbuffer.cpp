// obscura gbuffer: depth, normals and layers of a scene or mesh as EXR.
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/input.h"
#include "fmt/format.h"
#include "scene/views/gbuffer_file.h"

namespace obscura::app {
namespace {

struct GbufferCommand {
  InputOptions input;
  std::string output;
  int threads = 0;
  bool half = false;
};

Status run_gbuffer(const GbufferCommand& c, bool quiet) {
  LoadedInput input;
  if (Status s = c.input.load({}, c.threads, &input); !s.ok()) return s;
  if (!input.rendering.scene) {
    return invalid_argument(fmt::format(
        "{} is a depth image already; gbuffer renders scenes and meshes", c.input.path()));
  }
  if (Status s = tools::write_gbuffer(c.output, input.depth(), input.rendering.view, c.half);
      !s.ok()) {
    return s;
  }
  if (!quiet) {
    const GuardBand& g = input.depth().guard_band;
    fmt::print("{}: {}x{} with a guard band of {},{} px, scene size {:.4g}\n", c.output,
               input.rendering.view.width, input.rendering.view.height, g.left, g.top,
               input.depth().scene_size);
  }
  return {};
}

}  // namespace

void add_gbuffer(App& app) {
  auto c = std::make_shared<GbufferCommand>();
  CLI::App* command = app.add_command(
      "gbuffer", "Render depth, normals and depth layers of a scene or mesh to OpenEXR",
      [c, &app] { return run_gbuffer(*c, app.quiet); });
  command->add_option("-o,--output", c->output, "Result")->required()->type_name("FILE.exr");
  c->input.add_to(command);
  add_threads_option(command, &c->threads);
  command->add_flag("--half", c->half, "Write normals as 16-bit floats");
}

}  // namespace obscura::app
