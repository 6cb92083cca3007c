#include "filters/interleaved/gpu.h"

#include "shaders/interleaved.h"
#include "view/gpu.h"

namespace obscura::gpu {

SumRegions add_sums(const Frame& frame, bool open, bool directions, Program* program) {
  SumRegions sums;
  if (open) sums.open = program->add_region(frame.visible_bytes());
  if (directions) sums.directions = program->add_region(frame.visible_bytes(4));
  return sums;
}

void add_denoising(const Frame& frame, const Geometry& geometry, const SumRegions& sums,
                   const Denoising& how, const VisibilityTarget& target, Program* program) {
  namespace io = interleaved_io;
  const bool open = sums.open >= 0, directions = sums.directions >= 0;
  const bool normals = geometry.normals >= 0;
  // Every binding needs something, read or not.
  const int open_sums = open ? sums.open : sums.directions;
  Pass pass{.name = "blur",
            .shader = shaders::interleaved,
            .constants = {{io::kReach, how.interleave / 2},
                          {io::kHalfOutermost, how.interleave % 2 == 0},
                          {io::kChannels, (open ? 1 : 0) + (directions ? 4 : 0)},
                          {io::kOpen, open},
                          {io::kDirections, directions},
                          {io::kCosineOpen, how.cosine_open},
                          {io::kPaperCone, how.paper_cone},
                          {io::kUnsigned, frame.shape.directions == Directions::kUnsigned},
                          {io::kNormals, normals}},
            .slots = {{io::kDepthAt, geometry.depth},
                      {io::kNormalsAt, normals ? geometry.normals : geometry.depth},
                      {io::kOpenAt, open_sums},
                      {io::kDirectionsAt, directions ? sums.directions : open_sums},
                      {io::kDirectionResultAt, frame.results.directions}},
            .size = frame.visible(),
            .radius = how.edge,
            .push = push_words(io::Push{.edges_per_depth = how.edges_per_depth})};
  target.apply(&pass);
  program->add(std::move(pass));
}

void add_denoising(const Frame& frame, const Geometry& geometry, const SumRegions& sums,
                   const Denoising& how, Program* program) {
  // The target's region is not touched.
  add_denoising(frame, geometry, sums, how, {frame.results.visibility, sums.any()}, program);
}

}  // namespace obscura::gpu
