// obscura gbuffer: depth, normals and layers of a scene or mesh as EXR.
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/input.h"
#include "apps/obscura/sequence.h"
#include "fmt/format.h"
#include "scene/views/gbuffer_file.h"

namespace obscura::app {
namespace {

struct GbufferCommand {
  InputOptions input;
  SequenceOptions sequence;
  std::string output;
  int threads = 0;
  bool half = false;
};

class GbufferFrame : public CommandFrame {
 public:
  GbufferFrame(const GbufferCommand& command, FrameFiles files)
      : c_(command), files_(std::move(files)) {}

  // Geometry is small beside its rendering: both are one step.
  Status read() override { return {}; }
  Status compute(const std::function<bool(double)>& progress) override {
    if (Status s = c_.input.load(files_.input, nullptr, {}, c_.threads, &input_); !s.ok()) return s;
    if (!input_.rendering.scene) {
      return invalid_argument(fmt::format(
          "{} is a depth image already; gbuffer renders scenes and meshes", files_.input));
    }
    return progress(1) ? Status() : Status{StatusCode::kCancelled, "interrupted"};
  }
  Status write() override {
    return tools::write_gbuffer(files_.output, input_.depth(), input_.rendering.view, c_.half,
                                files_.made_by);
  }

  std::string line() const override {
    const GuardBand& g = input_.depth().guard_band;
    return fmt::format("{}: {}x{} with a guard band of {},{} px, scene size {:.4g}", files_.output,
                       input_.rendering.view.width, input_.rendering.view.height, g.left, g.top,
                       input_.depth().scene_size);
  }
  tools::Report report() const override { return {}; }

 private:
  const GbufferCommand& c_;
  const FrameFiles files_;
  LoadedInput input_;
};

Status run_gbuffer(const GbufferCommand& c, bool quiet) {
  return c.sequence.run(c.input.path(), c.output, quiet, "", [&](const FrameFiles& files) {
    return std::make_unique<GbufferFrame>(c, files);
  });
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
  c->sequence.add_to(command, false);
}

}  // namespace obscura::app
