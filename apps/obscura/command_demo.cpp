// obscura demo: two scenes, each with depth, normals and visibility as pictures.
#include <filesystem>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/methods.h"
#include "fmt/format.h"
#include "support/files/files.h"
#include "support/pictures/pictures.h"
#include "support/scenes/load_scene.h"

namespace obscura::app {
namespace {

struct DemoCommand {
  std::string folder = "demo";
  int threads = 0;
};

Status demo_scene(const DemoCommand& c, const std::string& name, double radius_share, bool quiet) {
  const auto executor = make_executor(c.threads);
  LoadedInput input;
  const std::string spec = "scene:" + name;
  if (Status s = support::load_scene(spec, {}, *executor, &input.rendering); !s.ok()) return s;
  input.rendering.gbuffer.name = spec;
  const DepthField field = input.field();
  const int width = field.visible_width(), height = field.visible_height();

  LineSettings settings;
  settings.falloff.radius = static_cast<float>(radius_share * input.depth().scene_size);
  support::Image visibility(width, height);
  visibility.add("visibility");
  if (Status s = run_method(MethodSettings(settings), input, c.threads,
                            {.visibility = visibility.view(0)}, {});
      !s.ok()) {
    return s;
  }

  auto visible = [&](const ImageView<const float>& v) {
    return ImageView<const float>(&v(field.guard_band.left, field.guard_band.top), width, height,
                                  v.row_stride);
  };
  const support::Image depth = support::depth_picture(visible(field.depth));
  const support::Image normals = support::vector_picture(
      {visible(field.normals.x), visible(field.normals.y), visible(field.normals.z)});
  const support::Image grey = support::grey_picture(visibility.view(0));
  const std::pair<const char*, const support::Image*> pictures[] = {
      {"depth", &depth}, {"normals", &normals}, {"visibility", &grey}};
  for (const auto& [what, picture] : pictures) {
    const std::string path = fmt::format("{}/{}-{}.png", c.folder, name, what);
    if (Status s = support::write_image(path, *picture); !s.ok()) return s;
  }
  double sum = 0;
  for (float v : visibility.channels[0].values) sum += v;
  if (!quiet) {
    fmt::print("{}: {}x{}, radius {:.3g}, mean visibility {:.3f}: {}/{}-*.png\n", name, width,
               height, settings.falloff.radius, sum / (width * height), c.folder, name);
  }
  return {};
}

Status run_demo(const DemoCommand& c, bool quiet) {
  std::error_code error;
  std::filesystem::create_directories(c.folder, error);
  if (error) {
    return {StatusCode::kInternal,
            fmt::format("cannot make the folder {}: {}", c.folder, error.message())};
  }
  if (Status s = demo_scene(c, "hall", 0.05, quiet); !s.ok()) return s;
  return demo_scene(c, "meadow", 0.05, quiet);
}

}  // namespace

void add_demo(App& app) {
  auto c = std::make_shared<DemoCommand>();
  CLI::App* command = app.add_command(
      "demo",
      "Render hall and meadow: depth, normals and visibility as PNG, a line of figures each",
      [c, &app] { return run_demo(*c, app.quiet); });
  command->add_option("-o,--output", c->folder, "Folder for the pictures [default demo]")
      ->type_name("FOLDER");
  add_threads_option(command, &c->threads);
}

}  // namespace obscura::app
