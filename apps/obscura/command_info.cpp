// obscura info: what a file holds.
#include <cstdio>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/backend.h"
#include "apps/obscura/describe_input.h"
#include "apps/obscura/output.h"
#include "apps/obscura/volume_input.h"
#include "fmt/format.h"
#include "io/images/describe.h"
#include "io/images/files.h"
#include "io/meshes/load_mesh.h"
#include "obscura/simd.h"
#include "scene/scenes/load_scene.h"

namespace obscura::app {
namespace {

struct InfoCommand {
  std::string path, json;
  bool devices = false, simd = false;
  VolumeInputOptions volume;
};

Status run_volume_info(const InfoCommand& c) {
  tools::VolumeImage image;
  tools::Json description;
  if (Status s = c.volume.load(c.path, 0, &image); !s.ok()) return s;
  if (Status s = tools::describe_volume(image, &description); !s.ok()) return s;
  if (c.json != "-") std::fputs(tools::volume_description_text(description).c_str(), stdout);
  if (c.json.empty()) return {};
  tools::Report report;
  report.settings = description;
  for (const char* metric : {"min", "max", "mean", "otsu_threshold", "finite", "nan", "infinite"}) {
    if (description.contains(metric)) {
      report.add("values", metric, description[metric].number());
    }
  }
  return write_json(report, c.json);
}

Status print_simd() {
  for (const std::string& target : simd_targets()) fmt::print("{}\n", target);
  return {};
}

Status describe(const std::string& path, tools::Json* description) {
  if (tools::is_scene(path)) return describe_scene(path, description);
  if (tools::is_mesh(path)) return describe_mesh(path, description);
  if (path.ends_with(".txt")) return describe_projection(path, description);
  return tools::describe_image(path, description);
}

Status run_info(const InfoCommand& c) {
  tools::Json description;
  if (c.devices) return print_devices();
  if (c.simd) return print_simd();
  if (c.path.empty()) return invalid_argument("FILE is missing; or say --devices or --simd");
  if (tools::is_volume(c.path)) return run_volume_info(c);
  if (Status s = describe(c.path, &description); !s.ok()) return s;
  if (c.json != "-") std::fputs(tools::description_text(description).c_str(), stdout);
  if (c.json.empty()) return {};
  tools::Report report;
  report.settings = description;
  if (!description.contains("channels")) return write_json(report, c.json);
  for (const tools::Json& channel : description["channels"].elements()) {
    for (const char* metric : {"min", "max", "finite", "nan", "infinite"}) {
      if (channel.contains(metric)) {
        report.add(channel["name"].text(), metric, channel[metric].number());
      }
    }
  }
  return write_json(report, c.json);
}

}  // namespace

void add_info(App& app) {
  auto c = std::make_shared<InfoCommand>();
  CLI::App* command =
      app.add_command("info", "What a file contains and how the other commands would read it",
                      [c] { return run_info(*c); });
  command
      ->add_option("FILE", c->path,
                   "Image: EXR, PFM, PNG or HDR; volume: .nii, .nii.gz, .nrrd, .nhdr, .vdb, .raw; "
                   "mesh: .obj, .ply, .gltf, .glb; scene:NAME; projection matrix: .txt")
      ->type_name("");
  command->add_flag("--devices", c->devices, "List the machine's Vulkan devices instead");
  command->add_flag("--simd", c->simd,
                    "List the SIMD targets that kernels can run with here, slowest first; the "
                    "environment variable OBSCURA_SIMD limits them to one of these");
  c->volume.add_to(command);
  command->add_option("--json", c->json, "Write it as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
