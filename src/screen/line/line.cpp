#include "screen/line/line.h"

#include <algorithm>
#include <cmath>

#include "core/reflection_noise.h"
#include "core/volumetric.h"
#include "math/disk_pattern.h"
#include "math/sphere_line.h"
#include "screen/line/line_kernel.h"

namespace obscura {
namespace {

constexpr int kRowsPerTask = 8;
constexpr int kChunk = 1024;  // pixels between kernel and strided outputs

void set_pattern(const std::vector<DiskSample>& pattern, LineFrame* f) {
  f->samples = static_cast<int>(pattern.size());
  double sum = 0;
  for (const DiskSample& s : pattern) sum += f->quadratic ? s.weight_quadratic : s.weight_constant;
  for (int i = 0; i < f->samples; ++i) {
    const DiskSample& s = pattern[i];
    const double square = static_cast<double>(s.x) * s.x + static_cast<double>(s.y) * s.y;
    const double lateral = std::sqrt(square), extent = std::sqrt(1 - square);
    const double unit = f->quadratic ? 1 : f->radius;
    const double half = f->quadratic ? math::quadratic_line(extent, lateral) : extent * unit;
    const double weight = f->quadratic ? s.weight_quadratic : s.weight_constant;
    f->x[i] = s.x;
    f->y[i] = s.y;
    f->lateral[i] = static_cast<float>(lateral);
    f->extent[i] = static_cast<float>(extent * unit);
    f->half[i] = static_cast<float>(half);
    f->weight[i] = static_cast<float>(weight / sum / (2 * half));
  }
}

class LineMethod final : public Method {
 public:
  LineMethod(const LineSettings& settings, const std::vector<DiskSample>& pattern) {
    // Beyond these a radius is past what depths in floats can tell apart or reach.
    frame_.radius = std::clamp(settings.falloff.radius, 1e-30f, 1e30f);
    frame_.quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
    if (settings.occluder.kind == OccluderKind::kThickness) {
      frame_.thickness = settings.occluder.thickness;
    }
    set_pattern(pattern, &frame_);
    if (settings.rotate) {
      noise_ = ReflectionNoise(settings.seed);
      frame_.noise_cos = noise_.cosines();
      frame_.noise_sin = noise_.sines();
    }
  }

  view::Needs needs() const override { return {.normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    LineFrame f = frame_;
    f.depth = g.depth.data();
    f.stride = g.depth.stride();
    if (g.has_normals) {
      f.normal_x = g.normal_x.data();
      f.normal_y = g.normal_y.data();
      f.normal_z = g.normal_z.data();
    }
    f.width = g.width;
    f.height = g.height;
    f.left = g.guard_band.left;
    f.top = g.guard_band.top;
    f.orthographic = g.camera.orthographic;
    f.scale_x = g.camera.scale_x;
    f.scale_y = g.camera.scale_y;
    f.center_u = g.camera.center_u;
    f.center_v = g.camera.center_v;

    const int width = g.visible_width(), height = g.visible_height();
    Progress progress(height, context.progress);
    context.executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
      if (progress.cancelled()) return;
      const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
      for (int y = first; y < end; ++y) write_row(f, y, width, outputs.visibility);
      progress.advance(end - first);
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    return {};
  }

 private:
  static void write_row(const LineFrame& f, int y, int width, const ImageView<float>& out) {
    if (out.pixel_stride == 1) return line_row(f, y, 0, width, &out(0, y));
    float chunk[kChunk];
    for (int x = 0; x < width; x += kChunk) {
      const int end = std::min(width, x + kChunk);
      line_row(f, y, x, end, chunk);
      for (int i = x; i < end; ++i) out(i, y) = chunk[i - x];
    }
  }

  LineFrame frame_;
  ReflectionNoise noise_;
};

}  // namespace

Status make_line(const LineSettings& settings, std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  return make_line_with(settings, disk_pattern(settings.samples), method);
}

Status make_line_with(const LineSettings& settings, const std::vector<DiskSample>& pattern,
                      std::unique_ptr<Method>* method) {
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  *method = std::make_unique<LineMethod>(settings, pattern);
  return {};
}

}  // namespace obscura
