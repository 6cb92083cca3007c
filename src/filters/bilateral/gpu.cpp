#include "filters/bilateral/gpu.h"

#include "shaders/bilateral.h"

namespace obscura::gpu {

void add_blur(const Frame& frame, const Geometry& geometry, int visibility, float edge,
              Program* program) {
  namespace io = bilateral_io;
  program->add({.name = "blur",
                .shader = shaders::bilateral,
                .slots = {{io::kDepthAt, geometry.depth},
                          {io::kValuesAt, visibility},
                          {io::kVisibilityResultAt, frame.results.visibility}},
                .size = frame.visible(),
                .push = push_words(io::Push{.edge = edge})});
}

}  // namespace obscura::gpu
