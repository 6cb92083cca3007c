#include "screen/volumetric/gpu.h"

#include "screen/gpu.h"
#include "screen/volumetric/line/plan.h"
#include "shaders/line.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

void add_line(const LineSettings& settings, const LineFrame& f, const Frame& frame,
              const Geometry& g, const VisibilityTarget& target, Program* program) {
  namespace io = line_io;
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight}) {
      pattern.push_back(column[i]);
    }
  }
  add_sampling({.name = "line",
                .shader = shaders::line,
                .constants = {{io::kQuadratic, f.quadratic}, {io::kTangent, f.tangent}},
                .radius = f.view.radius,
                .thickness = f.thickness,
                .push = push_words(io::Push{.pattern = program->add_table(pattern)})},
               {.samples = f.samples, .rotate = settings.rotate, .thickness = f.thickness > 0},
               frame, g, target, program);
}

}  // namespace

template <>
Status make_program(const LineSettings& settings, const Frame& frame, Program* program) {
  LinePlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (Status s = check({.method = "line"}, frame.shape); !s.ok()) return s;
  const bool normals = frame.shape.normal_use != NormalUse::kNone;
  if (settings.sphere == SphereKind::kTangent && !normals) {
    return invalid_argument("sphere is tangent, which needs normals, but normals are off");
  }
  const Geometry g = add_geometry(frame, normals, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  add_volumetric(
      settings, plan, frame, g,
      [&](const LineFrame& f, const VisibilityTarget& target) {
        add_line(settings, f, frame, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::gpu
