#include "view/gpu.h"

#include "shaders/depth.h"
#include "shaders/normals.h"
#include "shaders/widths.h"

namespace obscura::gpu {
namespace {

std::uint64_t depth_bytes(const FrameShape& shape) { return sizeof(float) * shape.size().pixels(); }

// Linear depth of an image of depth.
Pass conversion(const FrameShape& shape, Slot image, int region) {
  namespace io = depth_io;
  return {.name = "depth",
          .shader = shaders::depth,
          .constants = {{io::kDepthKind, static_cast<int>(shape.depth_kind)}},
          .slots = {{io::kDepthImageAt, image}, {io::kDepthAt, region}},
          .size = shape.size()};
}

// Where matter ends that is as thick as it is wide.
int add_widths(const FrameShape& shape, const Geometry& geometry, Program* program) {
  namespace io = widths_io;
  const int down = program->add_region(depth_bytes(shape));
  const int back = program->add_region(depth_bytes(shape));
  for (bool across : {false, true}) {
    program->add({.name = "widths",
                  .shader = shaders::widths,
                  .constants = {{io::kAcross, across}},
                  .slots = {{io::kDepthAt, geometry.depth},
                            {io::kDownAt, across ? down : geometry.depth},
                            {io::kRunsAt, across ? back : down}},
                  .size = {across ? shape.height : shape.width, 1}});
  }
  return back;
}

}  // namespace

Geometry add_geometry(const Frame& frame, bool normals, Program* program) {
  namespace io = normals_io;
  if (frame.geometry.depth >= 0) return frame.geometry;
  const FrameShape& shape = frame.shape;
  Geometry g;
  g.depth = program->add_region(depth_bytes(shape));
  program->add(conversion(shape, Slot::kDepthImage, g.depth));
  if (!normals) return g;
  g.normals = program->add_region(frame.visible_bytes(4));
  // A binding wants an image even where the pass is specialised not to read it.
  const Slot given = shape.normals ? Slot::kNormalImage : Slot::kDepthImage;
  program->add(
      {.name = "normals",
       .shader = shaders::normals,
       .constants = {{io::kGiven, shape.normals}},
       .slots = {{io::kDepthAt, g.depth}, {io::kNormalsAt, g.normals}, {io::kNormalImageAt, given}},
       .size = frame.visible()});
  return g;
}

int add_back_depth(const Frame& frame, const Geometry& geometry, Program* program) {
  if (frame.geometry.back >= 0) return frame.geometry.back;
  if (!frame.shape.back_depth) return add_widths(frame.shape, geometry, program);
  const int back = program->add_region(depth_bytes(frame.shape));
  Pass pass = conversion(frame.shape, Slot::kBackDepthImage, back);
  pass.overlaps = true;
  program->add(std::move(pass));
  return back;
}

}  // namespace obscura::gpu
