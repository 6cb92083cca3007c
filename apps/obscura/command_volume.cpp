// obscura volume: a picture of an isosurface with ambient visibility, shadow or translucency.
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/volume_command.h"
#include "apps/obscura/volume_stream.h"
#include "fmt/format.h"
#include "io/sequences/frame_names.h"
#include "scene/volumes/procedural.h"

namespace obscura::app {
namespace {

Status run_volume(const VolumeCommand& c, bool quiet) {
  VolumeRequest request;
  if (Status s = read_request(c, &request); !s.ok()) return s;
  if (c.sequence.given() && !c.fields.empty() && !tools::has_frame_number(c.fields)) {
    return invalid_argument(fmt::format(
        "--fields {} has no place for the frame's number; write #### or %04d there", c.fields));
  }
  const auto executor = make_executor(c.threads);
  if (!c.memory.empty()) return stream_volume(c, request, executor.get(), quiet);
  const std::string& output = c.output.empty() ? c.fields : c.output;
  return c.sequence.run(c.input, output, quiet, c.json, [&](const FrameFiles& files) {
    return make_volume_frame(c, request, executor.get(), quiet, files);
  });
}

}  // namespace

void add_volume(App& app) {
  auto c = std::make_shared<VolumeCommand>();
  CLI::App* command = app.add_command(
      "volume",
      "A volume's isosurface with ambient visibility, shadow or translucency, and its fields",
      [c, &app] { return run_volume(*c, app.quiet); });
  command
      ->add_option("INPUT", c->input,
                   "NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr), OpenVDB (.vdb), .raw, or " +
                       tools::procedural_volume_names() + " with ?size=N&seed=N")
      ->required()
      ->type_name("");
  command
      ->add_option(
          "-o,--output", c->output,
          "Picture: .png lit and in colours; linear visibility with background 1 in .exr and .pfm")
      ->type_name("FILE");
  command
      ->add_option(
          "--outputs", c->outputs,
          "Comma-separated results in place of a picture: visibility, coverage, depth [default "
          "visibility]")
      ->type_name("LIST");
  command
      ->add_option("--light", c->light,
                   fmt::format("{}; directions and octants in world space; octants are numbered "
                               "from (-,-,-), x fastest; lit is a sky, a lamp at the camera and "
                               "ambient visibility together [default lit in .png, else ao]",
                               tools::VolumeLight::kForm))
      ->type_name("LIGHT");
  c->table.declare("volume", VolumeSettings{});
  c->table.add_to(command, "Settings");
  c->volume.add_to(command);
  command
      ->add_option("--fields", c->fields,
                   "Write fields as floats, by the ending: .nrrd or .vdb; octants of the grid")
      ->type_name("FILE");
  command
      ->add_option(
          "--memory", c->memory,
          "Compute --fields within so much memory, such as 2G: slab by slab through files in "
          "FILE.work. The same command goes on with a run that was ended")
      ->type_name("SIZE");
  add_threads_option(command, &c->threads);
  command->add_flag("--half", c->half, "Write EXR channels as 16-bit floats");
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
  c->sequence.add_to(command, false);
}

}  // namespace obscura::app
