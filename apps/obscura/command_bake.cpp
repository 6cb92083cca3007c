// obscura bake: ambient visibility and bent normals at the vertices of a mesh, as PLY.
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/choices.h"
#include "apps/obscura/option_table.h"
#include "fmt/format.h"
#include "io/meshes/load_mesh.h"
#include "io/meshes/write_ply.h"
#include "io/report/progress_bar.h"
#include "scene/truth/mesh_points.h"
#include "scene/truth/vertex_normals.h"

namespace obscura::app {
namespace {

struct BakeCommand {
  std::string input, output, normals = "bent";
  int threads = 0;
  OptionTable table;
};

Status run_bake(const BakeCommand& c, bool quiet) {
  tools::MeshPointSettings settings;
  if (Status s = c.table.read(&settings); !s.ok()) return s;
  const bool bent = c.normals == "bent";
  if (!bent && c.normals != "surface") {
    return invalid_argument(
        fmt::format("--normals is '{}'; it must be one of bent, surface", c.normals));
  }
  if (!c.output.ends_with(".ply")) {
    return invalid_argument(fmt::format("--output is '{}'; it must end in .ply", c.output));
  }
  tools::Mesh mesh;
  if (Status s = tools::load_mesh(c.input, &mesh); !s.ok()) return s;
  std::size_t without = 0;
  std::vector<float> normals = tools::vertex_normals(mesh, &without);
  if (without > 0) {
    mesh.notes.push_back(
        fmt::format("{} of {} vertices belong to no triangle with an area; their normal is 0,0,1",
                    without, mesh.positions.size()));
  }
  for (const std::string& note : mesh.notes) {
    fmt::print(stderr, "obscura: note: {}\n", note);
  }
  std::vector<float> positions;
  positions.reserve(normals.size());
  for (const auto& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});

  std::unique_ptr<tools::RayScene> scene;
  if (Status s = tools::RayScene::create(std::move(mesh), &scene, c.threads); !s.ok()) return s;
  std::vector<float> visibility(normals.size() / 3), directions(bent ? normals.size() : 0);
  {
    tools::ProgressBar bar("bake", !quiet);
    const RunOptions options{.threads = c.threads,
                             .progress = [&bar](double share) { return bar(share); }};
    if (Status s = tools::trace_points(*scene, {positions, normals}, settings,
                                       {visibility, directions}, options);
        !s.ok()) {
      return s;
    }
  }
  if (Status s =
          tools::write_ply(c.output, scene->mesh(), {visibility, bent ? directions : normals});
      !s.ok()) {
    return s;
  }
  if (!quiet) {
    double sum = 0;
    for (const float v : visibility) sum += v;
    fmt::print("{}: {} vertices, {} triangles, mean visibility {:.3f}\n", c.output,
               visibility.size(), scene->mesh().triangles.size(),
               sum / static_cast<double>(visibility.size()));
  }
  return {};
}

}  // namespace

void add_bake(App& app) {
  auto c = std::make_shared<BakeCommand>();
  CLI::App* command = app.add_command(
      "bake", "Ambient visibility and bent normals at the vertices of a mesh, by rays, as PLY",
      [c, &app] { return run_bake(*c, app.quiet); });
  command->add_option("INPUT", c->input, "Mesh (.obj, .ply, .gltf, .glb, also with .gz behind it)")
      ->required()
      ->type_name("");
  command
      ->add_option("-o,--output", c->output,
                   "Result: the mesh with its visibility as a grey vertex colour and as a float")
      ->required()
      ->type_name("FILE.ply");
  CLI::Option* normals = command->add_option(
      "--normals", c->normals,
      "Normals of the result: bent ones (mean open directions) or the surface's [default bent]");
  normals->type_name("");
  set_choices(normals, std::vector<std::string>{"bent", "surface"});
  c->table.declare("bake", tools::MeshPointSettings{});
  c->table.add_to(command, "Rays");
  add_threads_option(command, &c->threads);
}

}  // namespace obscura::app
