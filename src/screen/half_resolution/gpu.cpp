#include "screen/half_resolution/gpu.h"

#include "filters/upsampling/kernel.h"
#include "shaders/halve.h"
#include "shaders/upsampling.h"
#include "view/gpu.h"
#include "view/half.h"

namespace obscura::gpu {
namespace {

view::HalfAxis half_columns(const FrameShape& s) {
  return view::halve(s.width, s.guard_band.left, s.visible().width);
}
view::HalfAxis half_rows(const FrameShape& s) {
  return view::halve(s.height, s.guard_band.top, s.visible().height);
}

FrameShape half_shape(const FrameShape& shape) {
  const view::HalfAxis x = half_columns(shape), y = half_rows(shape);
  FrameShape half = shape;
  half.width = x.size;
  half.height = y.size;
  half.guard_band = {x.before, x.after(), y.before, y.after()};
  if (shape.directions != Directions::kNone) half.directions = Directions::kSigned;
  return half;
}

// One image of depth and, unless they are -1, its normals.
void add_halving(const Frame& frame, const Geometry& whole, const Geometry& half, bool overlaps,
                 Program* program) {
  namespace io = halve_io;
  const view::HalfAxis x = half_columns(frame.shape), y = half_rows(frame.shape);
  const bool normals = half.normals >= 0;
  program->add({.name = "halve",
                .shader = shaders::halve,
                .constants = {{io::kNormals, normals}},
                .slots = {{io::kDepthAt, whole.depth},
                          {io::kNormalsAt, normals ? whole.normals : whole.depth},
                          {io::kHalfDepthAt, half.depth},
                          {io::kHalfNormalsAt, normals ? half.normals : half.depth}},
                .size = {x.size, y.size},
                .push = push_words(io::Push{.first_x = x.first,
                                            .first_y = y.first,
                                            .half_width = x.size,
                                            .half_height = y.size,
                                            .half_left = x.before,
                                            .half_top = y.before,
                                            .half_visible_width = x.visible,
                                            .half_visible_height = y.visible}),
                .overlaps = overlaps});
}

Geometry add_half_geometry(const Frame& frame, const Geometry& whole, const FrameShape& shape,
                           Program* program) {
  const std::uint64_t depth_bytes = sizeof(float) * shape.size().pixels();
  Geometry half;
  half.depth = program->add_region(depth_bytes);
  if (whole.normals >= 0) {
    half.normals = program->add_region(4 * sizeof(float) * shape.visible().pixels());
  }
  add_halving(frame, whole, half, false, program);
  if (whole.back >= 0) {
    half.back = program->add_region(depth_bytes);
    add_halving(frame, {.depth = whole.back}, {.depth = half.back}, true, program);
  }
  return half;
}

void add_upsampling(const Frame& frame, const Geometry& whole, const Results& half,
                    Program* program) {
  namespace io = upsampling_io;
  const bool normals = whole.normals >= 0;
  program->add({.name = "fill in",
                .shader = shaders::upsampling,
                .constants = {{io::kNormals, normals},
                              {io::kDirections, frame.directions()},
                              {io::kUnsigned, frame.shape.directions == Directions::kUnsigned}},
                .slots = {{io::kDepthAt, whole.depth},
                          {io::kNormalsAt, normals ? whole.normals : whole.depth},
                          {io::kSeenAt, half.visibility},
                          {io::kSeenDirectionsAt, half.directions},
                          {io::kVisibilityResultAt, frame.results.visibility},
                          {io::kDirectionResultAt, frame.results.directions}},
                .size = frame.visible(),
                .push = push_words(io::Push{.edge = kUpsamplingEdge})});
}

}  // namespace

FrameConstants half_frame_constants(const FrameShape& shape, const FrameView& view) {
  return frame_constants(half_shape(shape),
                         view::halve(view.camera, half_columns(shape), half_rows(shape)), view);
}

Status make_half_program(const Frame& frame, bool back,
                         const std::function<Status(const Frame& half)>& make, Program* program) {
  const FrameShape shape = half_shape(frame.shape);
  Geometry whole = add_geometry(frame, shape.normal_use != NormalUse::kNone, program);
  if (back) whole.back = add_back_depth(frame, whole, program);
  const Geometry geometry = add_half_geometry(frame, whole, shape, program);
  const std::uint64_t bytes = sizeof(float) * shape.visible().pixels();
  const Slot visibility = program->add_region(bytes);
  const Slot directions = frame.directions() ? Slot(program->add_region(4 * bytes)) : visibility;
  const Frame half{.shape = shape, .results = {visibility, directions}, .geometry = geometry};
  program->half = true;
  if (Status s = make(half); !s.ok()) return s;
  program->half = false;
  add_upsampling(frame, whole, half.results, program);
  return {};
}

}  // namespace obscura::gpu
