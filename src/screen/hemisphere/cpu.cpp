#include "screen/hemisphere/plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "filters/interleaved/interleaved.h"
#include "screen/method.h"

namespace obscura {
namespace {

using interleaved::kChannels;
using interleaved::Sums;

constexpr int kRowsPerTask = 8;

class HemisphereMethod final : public Method {
 public:
  HemisphereMethod(const HemisphereSettings& settings, const hemisphere::Frame& frame, int width,
                   int height)
      : settings_(settings), frame_(frame) {
    if (settings.radiance) set_light();
    sums_.resize(width, height);
  }

  view::Needs needs() const override {
    return view::Needs{.normals = true}.with(settings_.occluder, false);
  }
  OutputKinds output_kinds() const override {
    return {.bent_normal = true,
            .cone_angle = true,
            .uniform_integral = true,
            .cosine_integral = true,
            .radiance = static_cast<bool>(settings_.radiance)};
  }

  Status run(const view::Geometry& g, const Outputs& o, const RunContext& context) override {
    if (!g.has_normals) return unsupported("hemisphere needs normals; normal_use is none");
    set_view(g);
    const bool directions =
        !o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty();
    const bool uniform_visibility = settings_.weighting == RayWeighting::kUniform;
    // The kinds of sums one after the other: they share their memory, and few want several.
    Outputs left = o;
    if (directions || uniform_visibility) {
      Outputs part;
      part.bent_normal = o.bent_normal;
      part.cone_angle = o.cone_angle;
      part.uniform_integral = o.uniform_integral;
      if (uniform_visibility) std::swap(part.visibility, left.visibility);
      if (Status s = pass(g, part, Sums::kUniform, directions, context); !s.ok()) return s;
    }
    if (!left.visibility.empty() || !o.cosine_integral.empty()) {
      Outputs part;
      part.visibility = left.visibility;
      part.cosine_integral = o.cosine_integral;
      if (Status s = pass(g, part, Sums::kCosine, !o.cosine_integral.empty(), context); !s.ok())
        return s;
    }
    if (o.radiance.empty()) return {};
    Outputs part;
    part.radiance = o.radiance;
    return pass(g, part, Sums::kRadiance, true, context);
  }

 private:
  void set_light() {
    constexpr int kCells = 32, kSide = kCells + 1;
    for (auto& plane : light_) plane.resize(std::size_t{6} * kSide * kSide);
    std::size_t at = 0;
    for (int face = 0; face < 6; ++face) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i, ++at) {
          const int axis = face / 2;
          double w[3];
          w[axis] = face % 2 == 0 ? 1 : -1;
          w[(axis + 1) % 3] = 2.0 * i / kCells - 1;
          w[(axis + 2) % 3] = 2.0 * j / kCells - 1;
          const double scale = 1 / std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
          const auto rgb =
              settings_.radiance({float(w[0] * scale), float(w[1] * scale), float(w[2] * scale)});
          for (int c = 0; c < 3; ++c) light_[c][at] = rgb[c];
        }
      }
    }
    for (int c = 0; c < 3; ++c) frame_.light[c] = light_[c].data();
    frame_.light_cells = kCells;
  }

  void set_view(const view::Geometry& g) {
    frame_.depth = g.depth.data();
    frame_.normal[0] = g.normal_x.data();
    frame_.normal[1] = g.normal_y.data();
    frame_.normal[2] = g.normal_z.data();
    frame_.back = frame_.matter == view::Matter::kWithBack ? g.back_depth.data() : nullptr;
    frame_.stride = g.depth.stride();
    frame_.width = g.width;
    frame_.height = g.height;
    frame_.left = g.guard_band.left;
    frame_.top = g.guard_band.top;
    frame_.orthographic = g.camera.orthographic;
    frame_.scale_x = g.camera.scale_x;
    frame_.scale_y = g.camera.scale_y;
    frame_.center_u = g.camera.center_u;
    frame_.center_v = g.camera.center_v;
  }

  // Sums of one kind, their blur, and the results that come from them.
  Status pass(const view::Geometry& g, const Outputs& o, Sums kind, bool directions,
              const RunContext& context) {
    const int width = g.visible().width, height = g.visible().height;
    const int channels = directions ? kChannels : 1;
    Progress progress(height, context.progress);
    auto sum_rows = [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        hemisphere::Sums sums;
        float** to = kind == Sums::kUniform  ? sums.uniform
                     : kind == Sums::kCosine ? sums.cosine
                                             : sums.radiance;
        for (int c = 0; c < (kind == Sums::kRadiance ? 3 : channels); ++c) to[c] = sums_.row(c, y);
        hemisphere::sum_row(frame_, y, width, sums);
        sums_.close_row(channels, width, y);
      }
    };
    context.timer.time("sample", [&] {
      const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
      context.executor.parallel_for(tasks, [&](int task, int) {
        if (progress.cancelled()) return;
        const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
        sum_rows(first, end);
        progress.advance(end - first);
      });
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    context.timer.time("blur", [&] {
      sums_.resolve(g,
                    {.sums = kind,
                     .directions = directions,
                     .interleave = settings_.blur ? settings_.interleave : 1,
                     .edge = 0.5f * frame_.radius,
                     .paper_cone = settings_.cone == ConeEstimate::kPaper},
                    o, context.executor);
    });
    return {};
  }

  const HemisphereSettings settings_;
  hemisphere::Frame frame_;
  interleaved::InterleavedSums sums_;
  std::vector<float> light_[3];
};

}  // namespace

template <>
Status make_method(const HemisphereSettings& settings, int width, int height,
                   std::unique_ptr<Method>* method) {
  hemisphere::Frame frame;
  if (Status s = make_plan(settings, &frame); !s.ok()) return s;
  *method = std::make_unique<HemisphereMethod>(settings, frame, width, height);
  return {};
}

}  // namespace obscura
