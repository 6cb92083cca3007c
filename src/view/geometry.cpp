#include "view/geometry.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "core/text.h"
#include "math/leaf_scalar.h"
#include "view/check_view.h"
#include "view/normals.h"
#include "view/widths.h"

namespace obscura {
namespace leaf_scalar {
#include "view/depth_leaf.h"
}  // namespace leaf_scalar

namespace view {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kRowsPerTask = 16;

Status check_same_size(const ImageView<const float>& image, const DepthField& field,
                       const char* name) {
  if (image.empty()) return invalid_input(text(name, " is missing"));
  if (image.width == field.depth.width && image.height == field.depth.height) return {};
  return invalid_input(text(name, " is ", image.width, "x", image.height, "; it must be ",
                            field.depth.width, "x", field.depth.height, " like depth"));
}

Status check(const DepthField& field, const Needs& needs) {
  const int w = field.depth.width, h = field.depth.height;
  if (field.depth.empty()) return invalid_input("depth is missing");
  if (w < 1 || h < 1 || w > 65535 || h > 65535) {
    return invalid_input(text("depth is ", w, "x", h, "; each side must be in [1, 65535]"));
  }
  const GuardBand& g = field.guard_band;
  if (g.left < 0 || g.right < 0 || g.top < 0 || g.bottom < 0 || field.visible().width < 1 ||
      field.visible().height < 1) {
    return invalid_input(text("guard_band (left ", g.left, ", right ", g.right, ", top ", g.top,
                              ", bottom ", g.bottom, ") leaves nothing visible of a ", w, "x", h,
                              " depth image"));
  }
  if (!is_valid_enum(field.depth_kind)) return no_such_value("depth_kind", field.depth_kind);
  if (field.normal_use != NormalUse::kAuto && field.normal_use != NormalUse::kNone) {
    return invalid_argument(text("normal_use is ", static_cast<int>(field.normal_use),
                                 "; it must be 0 (auto) or 1 (none)"));
  }
  if (Status s = check_view(field.camera, field.depth_kind, field.near_plane, field.far_plane);
      !s.ok()) {
    return s;
  }
  if (!field.normals.empty()) {
    for (const auto* n : {&field.normals.x, &field.normals.y, &field.normals.z}) {
      if (Status s = check_same_size(*n, field, "normals"); !s.ok()) return s;
    }
  }
  if (field.normal_use == NormalUse::kNone && needs.normals && !needs.works_without_normals) {
    return unsupported("normals are switched off; this method needs them");
  }
  if (needs.back_depth) {
    if (Status s = check_same_size(field.back_depth, field, "back_depth"); !s.ok()) return s;
  }
  if (needs.layers > static_cast<int>(field.layers.size())) {
    return invalid_input(
        text("layers holds ", field.layers.size(), "; the occluder asks for ", needs.layers));
  }
  for (int i = 0; i < needs.layers; ++i) {
    if (Status s = check_same_size(field.layers[i].front, field, "a layer's front"); !s.ok()) {
      return s;
    }
    if (Status s = check_same_size(field.layers[i].back, field, "a layer's back"); !s.ok()) {
      return s;
    }
  }
  return {};
}

// Of the occluder `auto`: the best of what a depth field says about matter.
void choose_matter(DepthField* field, Needs* needs) {
  const auto given = static_cast<int>(field->layers.size());
  if (needs->any_layers) {
    needs->layers = std::min(given, static_cast<int>(Occluder::kLayersRange.max));
  } else if (field->back_depth.empty() && given > 0) {
    field->back_depth = field->layers[0].back;
  }
  needs->back_depth = needs->layers == 0 && !field->back_depth.empty();
}

// The one place that turns a depth value of any kind into linear depth. Background becomes +inf;
// values that no surface can have become NaN.
class DepthConversion {
 public:
  explicit DepthConversion(const DepthField& f)
      : camera_(f.camera),
        kind_(f.depth_kind),
        near_(f.near_plane),
        far_(std::min(f.far_plane, leaf_scalar::kFarthestDepth)),
        far_plane_(f.far_plane) {}

  void row(const float* in, std::ptrdiff_t step, int width, int y, float* out) const {
    switch (kind_) {
      case DepthKind::kLinear:
        return each(in, step, width, out, [](float v, int) { return v; });
      case DepthKind::kDistance: {
        if (camera_.orthographic) return each(in, step, width, out, [](float v, int) { return v; });
        const float b = (camera_.center_v - (y + 0.5f)) * camera_.scale_y;
        return each(in, step, width, out, [&](float v, int x) {
          const float a = (x + 0.5f - camera_.center_u) * camera_.scale_x;
          return leaf_scalar::depth_of_distance(v, a, b);
        });
      }
      case DepthKind::kNdc:
        return each(in, step, width, out, [&](float v, int) { return from_ndc(1 - v, v); });
      case DepthKind::kNdcReversed:
        return each(in, step, width, out, [&](float v, int) { return from_ndc(v, 1 - v); });
    }
  }

 private:
  template <class F>
  void each(const float* in, std::ptrdiff_t step, int width, float* out, F linear) const {
    for (int x = 0; x < width; ++x) {
      const float v = in[x * step];
      const float d = linear(v, x);
      const float surface = d > 0 ? d : kNan;
      out[x] = std::isnan(v) || d >= far_ ? kInf : surface;
    }
  }
  float from_ndc(float reversed, float forward) const {
    if (std::isinf(forward)) return forward > 0 && kind_ == DepthKind::kNdc ? kInf : kNan;
    if (!(reversed >= 0 && forward >= 0)) return kNan;
    if (reversed <= 0) return kInf;
    return leaf_scalar::depth_of_ndc(reversed, forward, near_, far_plane_, camera_.orthographic,
                                     std::isinf(far_plane_));
  }

  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Camera camera_;
  const DepthKind kind_;
  const float near_, far_, far_plane_;  // far_: where nothing is any more
};

Status bad_depth(const DepthField& field, const ImageView<const float>& image, const char* name,
                 std::int64_t at) {
  const int x = static_cast<int>(at % image.width), y = static_cast<int>(at / image.width);
  const bool ndc =
      field.depth_kind == DepthKind::kNdc || field.depth_kind == DepthKind::kNdcReversed;
  return invalid_input(text(name, " at pixel (", x, ", ", y, ") is ", image(x, y), "; ",
                            ndc ? "NDC depth must be in [0, 1]"
                                : "depth must be positive, background +inf, NaN or at least far"));
}

// Converts a whole image; remembers the first pixel without a valid depth.
Status convert_image(const DepthField& field, const ImageView<const float>& in, const char* name,
                     Executor& executor, AlignedImage<float>* out) {
  out->resize(in.width, in.height);
  const DepthConversion conversion(field);
  constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  std::atomic<std::int64_t> first_bad{kNone};
  const int tasks = (in.height + kRowsPerTask - 1) / kRowsPerTask;
  executor.parallel_for(tasks, [&](int task, int) {
    const int end = std::min(in.height, (task + 1) * kRowsPerTask);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      float* row = out->row(y);
      conversion.row(in.data + y * in.row_stride, in.pixel_stride, in.width, y, row);
      for (int x = 0; x < in.width; ++x) {
        if (!std::isnan(row[x])) continue;
        const std::int64_t at = static_cast<std::int64_t>(y) * in.width + x;
        std::int64_t known = first_bad.load();
        while (at < known && !first_bad.compare_exchange_weak(known, at)) {
        }
        break;
      }
    }
  });
  return first_bad == kNone ? Status() : bad_depth(field, in, name, first_bad);
}

// A back that is missing or in front of its own front means no thickness at all.
void clamp_back(const AlignedImage<float>& front, Executor& executor, AlignedImage<float>* back) {
  executor.parallel_for(front.height(), [&](int y, int) {
    const float* f = front.row(y);
    float* b = back->row(y);
    for (int x = 0; x < front.width(); ++x) b[x] = std::max(b[x], f[x]);
  });
}

}  // namespace

void find_depth_range(Executor& executor, Geometry* g) {
  std::vector<float> lo(g->height, kInf), hi(g->height, 0.0f);
  const int tasks = (g->height + kRowsPerTask - 1) / kRowsPerTask;
  executor.parallel_for(tasks, [&](int task, int) {
    for (int y = task * kRowsPerTask; y < std::min(g->height, (task + 1) * kRowsPerTask); ++y) {
      const float* row = g->depth.row(y);
      float a = kInf, b = 0;
      for (int x = 0; x < g->width; ++x) {
        a = std::min(a, row[x]);
        b = std::max(b, row[x] == kInf ? 0.0f : row[x]);
      }
      lo[y] = a;
      hi[y] = b;
    }
  });
  g->min_depth = *std::min_element(lo.begin(), lo.end());
  g->max_depth = *std::max_element(hi.begin(), hi.end());
  if (g->min_depth == kInf) g->min_depth = 0;
}

Needs& Needs::with(const Occluder& occluder, bool takes_layers) {
  back_depth = occluder.kind == OccluderKind::kBackDepth;
  layers = occluder.kind == OccluderKind::kLayers ? occluder.layers : 0;
  automatic = occluder.kind == OccluderKind::kAuto;
  any_layers = takes_layers;
  return *this;
}

Status convert(const DepthField& given, const Needs& asked, Executor& executor,
               Geometry* geometry) {
  DepthField field = given;
  Needs needs = asked;
  if (needs.automatic) choose_matter(&field, &needs);
  if (Status s = check(field, needs); !s.ok()) return s;
  Geometry& g = *geometry;
  g.width = field.depth.width;
  g.height = field.depth.height;
  g.guard_band = field.guard_band;
  g.camera = field.camera;
  if (Status s = convert_image(field, field.depth, "depth", executor, &g.depth); !s.ok()) return s;
  find_depth_range(executor, &g);
  if (needs.back_depth) {
    Status s = convert_image(field, field.back_depth, "back_depth", executor, &g.back_depth);
    if (!s.ok()) return s;
    clamp_back(g.depth, executor, &g.back_depth);
  }
  g.layers.resize(needs.layers);
  for (int i = 0; i < needs.layers; ++i) {
    Geometry::Layer& layer = g.layers[i];
    Status s =
        convert_image(field, field.layers[i].front, "a layer's front", executor, &layer.front);
    if (!s.ok()) return s;
    s = convert_image(field, field.layers[i].back, "a layer's back", executor, &layer.back);
    if (!s.ok()) return s;
    clamp_back(layer.front, executor, &layer.back);
  }
  if (needs.automatic && !needs.back_depth && needs.layers == 0) back_from_widths(executor, &g);
  g.has_normals = needs.normals && field.normal_use == NormalUse::kAuto;
  if (g.has_normals) compute_normals(field.normals, executor, &g);
  return {};
}

}  // namespace view
}  // namespace obscura
