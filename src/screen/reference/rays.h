#ifndef OBSCURA_SRC_SCREEN_REFERENCE_RAYS_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_RAYS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/falloff.h"

// What the host code of the reference tracer and its kernels say to each other.
//
// Rays live in the space (x, y, height): x and y are pixel coordinates, rightwards and downwards,
// height is 1/depth (parallel cameras: -depth). The camera maps straight lines to straight lines
// there, so a ray is (x, y, h) + s (gx, gy, gh), and the surface is a height field: a ray is behind
// it where it is lower. Heights are kept relative to the receiver's own, which is exact where it
// matters, close to it.
namespace obscura {

// Nearest-texel matter from `front` to `back`, linear depths; +inf: none. Images are addressed from
// their middle row. The pyramids hold the greatest and least heights of the layer's matter.
struct MatterLayer {
  const float* front = nullptr;
  const float* back = nullptr;
  const float* highest = nullptr;
  const float* lowest = nullptr;
};

struct TraceScene {
  bool boxes = false;  // layers of matter on whole texels instead of a surface between centres
  bool orthographic = false;
  // Cells of level 0: between texel centres (coordinates count from the first centre), or texels
  // (coordinates count from the image's corner).
  int cells_x = 0, cells_y = 0;
  // Images are addressed from their middle row, so that 65535 rows of 65536 fit 32 bits.
  int middle = 0;
  std::ptrdiff_t stride = 0;
  const float* heights = nullptr;     // middle row; surface only
  std::vector<MatterLayer> layers{};  // boxes only

  // Of each block of 2^level cells a side, from level 1 to `top_level`: the greatest height of the
  // surface in it (matter has a pyramid for each layer, as what is empty between layers would not
  // show in one for all). Level l is at 2^(log_x + log_y - 2 l), its rows 2^(log_x - l) apart.
  const float* highest = nullptr;
  int log_x = 0, log_y = 0, top_level = 0;
  float max_height = 0;

  // In eye space: a pixel's size at depth 1, or anywhere for a parallel camera.
  float scale_x = 0, scale_y = 0;
  float max_distance = 0;   // rho is 0 beyond, or less than float rounding; inf: never
  float beyond_border = 0;  // inf: nothing beyond
};

// Where a pixel's rays start and about which frame.
struct Receiver {
  float x = 0, y = 0;               // lattice coordinates of the start
  float height = 0, reference = 0;  // the start's above the surface point's, and that one
  float ray_x = 0, ray_y = 0;       // the start is (ray_x, ray_y, -1) depth; 0 if parallel
  float depth = 1;                  // of the start; 1 if parallel
  float normal[3] = {}, tangent[3] = {}, bitangent[3] = {};
};

// The points [first, first + count) of an independently scrambled net of `size` points.
struct RaySet {
  bool uniform = false;  // over the hemisphere; false: in proportion to the cosine
  int size = 0, first = 0, count = 0;
  std::uint32_t seed = 0;
};

// As many rays as fit a near cache, structure of arrays.
struct RayBatch {
  static constexpr int kCapacity = 1024;

  int count = 0;
  // Unit direction in eye space, and what turns s into distance: s depth / (1 + s bend).
  alignas(64) float wx[kCapacity], wy[kCapacity], wz[kCapacity];
  alignas(64) float depth[kCapacity], bend[kCapacity];
  // The ray, and the s at which it can meet nothing any more.
  alignas(64) float x[kCapacity], y[kCapacity], h[kCapacity], reference[kCapacity];
  alignas(64) float gx[kCapacity], gy[kCapacity], gh[kCapacity], end[kCapacity];
  // Distance of what is met beyond the border, or inf; after finish_rays, of whatever is met.
  alignas(64) float distance[kCapacity];
  alignas(64) float hit[kCapacity];  // s of the first blocked point, or inf
};

struct RaySums {
  float open = 0;             // sum of V = 1 - rho(d)
  float x = 0, y = 0, z = 0;  // sum of V w
};

// Appends a receiver's rays to a batch that has room for them.
void add_rays(const TraceScene& scene, const Receiver& receiver, const RaySet& set,
              RayBatch* batch);

// Finds where each ray of a batch is first blocked, and turns that into its distance.
void trace_surface(const TraceScene& scene, RayBatch* batch);
void trace_boxes(const TraceScene& scene, RayBatch* batch);
void finish_rays(RayBatch* batch);

// Sums over rays [begin, end) of a finished batch.
RaySums sum_rays(const math::Rho& rho, const RayBatch& batch, int begin, int end);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_RAYS_H_
