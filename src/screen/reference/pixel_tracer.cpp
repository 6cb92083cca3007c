#include "screen/reference/pixel_tracer.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

// Pixels. A fixed thickness makes stairs of every slope, which would darken it; known extents are
// true to their own texels, and 1 px is closer to the real geometry than 3 (docs/methods).
constexpr float kSurfaceOffset = 0.001f, kThicknessOffset = 3, kExtentOffset = 1;
float default_offset(OccluderKind kind) {
  if (kind == OccluderKind::kSolid) return kSurfaceOffset;
  return kind == OccluderKind::kThickness ? kThicknessOffset : kExtentOffset;
}

// A slab holds at least this many rays of each net: fewer would say nothing of their joint noise.
constexpr int kRaysPerSlab = 16;

std::uint32_t mix(std::uint32_t h, std::uint32_t v) {
  h ^= v;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

int slab_count(int rays, int max_slabs) {
  return std::clamp(rays / 2 / kRaysPerSlab, 1, max_slabs);
}

// Two directions that make a right-handed frame with the normal (Duff et al. 2017).
void make_frame(Receiver* r) {
  const float* n = r->normal;
  const float sign = std::copysign(1.0f, n[2]);
  const float a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  r->tangent[0] = 1 + sign * n[0] * n[0] * a;
  r->tangent[1] = sign * b;
  r->tangent[2] = -sign * n[0];
  r->bitangent[0] = b;
  r->bitangent[1] = sign + n[1] * n[1] * a;
  r->bitangent[2] = -n[1];
}

}  // namespace

Receiver make_receiver(const PixelTracer::Frame& f, Pixel pixel) {
  const view::Geometry& g = *f.geometry;
  const Camera& c = g.camera;
  const int x = pixel.x + g.guard_band.left, y = pixel.y + g.guard_band.top;
  Receiver r;
  const float* normals[] = {g.normal_x.row(y) + x, g.normal_y.row(y) + x, g.normal_z.row(y) + x};
  for (int k = 0; k < 3; ++k) r.normal[k] = *normals[k];
  make_frame(&r);

  // (a, b, -1) times the depth, or, of a parallel camera, (a, b, -depth).
  const double z = g.depth(x, y);
  const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
  const double pixel_size =
      std::sqrt(static_cast<double>(c.scale_x) * c.scale_y) * (c.orthographic ? 1 : z);
  const bool boxes = f.scene->boxes;
  const double pixels =
      f.settings->offset_px > 0 ? f.settings->offset_px : default_offset(f.settings->occluder.kind);
  double offset = pixels * pixel_size;
  // A step out of the surface by `offset`: along the normal, or along the view ray, which leaves
  // the pixel where it is. Never farther than half way to the camera.
  const double length = c.orthographic ? 1 : std::sqrt(1 + a * a + b * b);
  const double towards = boxes ? r.normal[2] : 1 / length;
  if (!c.orthographic && towards * offset > z / 2) offset = z / 2 / towards;
  const double start_z = z - towards * offset;
  r.x = static_cast<float>(x);
  r.y = static_cast<float>(y);
  if (boxes) {
    const double unit = c.orthographic ? 1 : z, start_unit = c.orthographic ? 1 : start_z;
    const double px = a * unit + r.normal[0] * offset, py = b * unit + r.normal[1] * offset;
    r.x = static_cast<float>(c.center_u + px / (c.scale_x * start_unit));
    r.y = static_cast<float>(c.center_v - py / (c.scale_y * start_unit));
    r.ray_x = static_cast<float>(px / start_unit);
    r.ray_y = static_cast<float>(py / start_unit);
  } else {
    r.ray_x = static_cast<float>(a);
    r.ray_y = static_cast<float>(b);
  }
  if (c.orthographic) {
    r.reference = -g.depth(x, y);
    r.height = static_cast<float>(z - start_z);
    r.ray_x = r.ray_y = 0;
  } else {
    r.reference = 1 / g.depth(x, y);
    r.height = static_cast<float>((z - start_z) / (z * start_z));
    r.depth = static_cast<float>(start_z);
  }
  return r;
}

void PixelTracer::flush(const Frame& f) {
  if (batch_.count == 0) return;
  f.scene->boxes ? trace_boxes(*f.scene, &batch_) : trace_surface(*f.scene, &batch_);
  finish_rays(&batch_);
  for (const Piece& piece : pieces_) {
    const RaySums s = sum_rays(*f.rho, batch_, piece.begin, piece.end);
    piece.to->open += s.open;
    piece.to->x += s.x;
    piece.to->y += s.y;
    piece.to->z += s.z;
    if (!piece.lit) continue;
    for (int i = piece.begin; i < piece.end; ++i) {
      const RaySums one = sum_rays(*f.rho, batch_, i, i + 1);
      if (one.open == 0) continue;
      const auto light = f.settings->radiance({batch_.wx[i], batch_.wy[i], batch_.wz[i]});
      for (int k = 0; k < 3; ++k) {
        piece.to->radiance[k] += static_cast<double>(one.open) * light[k];
      }
    }
  }
  pieces_.clear();
  batch_.count = 0;
}

void PixelTracer::trace_set(const Frame& f, const Receiver& receiver, bool uniform,
                            std::uint32_t seed, Slabs* slabs) {
  *slabs = {};
  const int rays = f.settings->rays, slab_total = slab_count(rays, kMaxSlabs);
  for (int net = 0; net < 2; ++net) {
    RaySet set;
    set.uniform = uniform;
    set.size = (rays + 1 - net) / 2;
    set.seed = mix(seed, static_cast<std::uint32_t>(2 * uniform + net));
    for (int slab = 0; slab < slab_total; ++slab) {
      auto bound = [&](int i) {
        return static_cast<int>(static_cast<std::int64_t>(set.size) * i / slab_total);
      };
      const int end = bound(slab + 1);
      for (set.first = bound(slab); set.first < end; set.first += set.count) {
        set.count = std::min(end - set.first, RayBatch::kCapacity - batch_.count);
        const int begin = batch_.count;
        add_rays(*f.scene, receiver, set, &batch_);
        pieces_.push_back({&slabs->of[net][slab], begin, batch_.count, f.radiance && !uniform});
        if (batch_.count == RayBatch::kCapacity) flush(f);
      }
    }
  }
}

void PixelTracer::trace(const Frame& f, const Pixel* pixels, int count, PixelEstimate* estimates) {
  pieces_.reserve(RayBatch::kCapacity);
  for (int i = 0; i < count; ++i) {
    const Receiver receiver = make_receiver(f, pixels[i]);
    // Of the pixel's place, so that neither threads nor the other pixels matter.
    const std::uint32_t seed =
        mix(mix(mix(0x9e3779b9u, f.settings->seed), static_cast<std::uint32_t>(pixels[i].x)),
            static_cast<std::uint32_t>(pixels[i].y));
    if (f.cosine) trace_set(f, receiver, false, seed, &slabs_[i][0]);
    if (f.uniform) trace_set(f, receiver, true, seed, &slabs_[i][1]);
  }
  flush(f);

  const int rays = f.settings->rays, slab_total = slab_count(rays, kMaxSlabs);
  auto estimate = [&](const Slabs& slabs) {
    HemisphereEstimate e;
    double squares = 0;
    for (int k = 0; k < slab_total; ++k) {
      const Sums &a = slabs.of[0][k], &b = slabs.of[1][k];
      e.visibility += (a.open + b.open) / rays;
      e.direction[0] += (a.x + b.x) / rays;
      e.direction[1] += (a.y + b.y) / rays;
      e.direction[2] += (a.z + b.z) / rays;
      for (int c = 0; c < 3; ++c) e.radiance[c] += (a.radiance[c] + b.radiance[c]) / rays;
      squares += (a.open - b.open) * (a.open - b.open);
    }
    // Each slab's difference has the variance of its sum. Of a single ray nothing is known but that
    // V is in [0, 1].
    e.standard_error = rays > 1 ? std::sqrt(squares) / rays : 0.5;
    return e;
  };
  for (int i = 0; i < count; ++i) {
    if (f.cosine) estimates[i].cosine = estimate(slabs_[i][0]);
    if (f.uniform) estimates[i].uniform = estimate(slabs_[i][1]);
  }
}

}  // namespace obscura
