#include "screen/hemisphere/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "core/volumetric.h"
#include "filters/bilateral_kernel.h"
#include "screen/hemisphere/hemisphere_kernel.h"

namespace obscura {
namespace {

using hemisphere::kChannels;

constexpr int kRowsPerTask = 8;
constexpr int kMargin = 16;  // pixels left and right of each row

// 0 ... count - 1 in random order.
std::vector<int> shuffled(int count, Random* random) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) {
    const int j = random->below(i + 1);
    order[i] = order[j];
    order[j] = i;
  }
  return order;
}

// The directions' azimuths advance by the golden angle; each pixel of the tile turns them by its
// own part of the circle and shifts them by its own parts of a stratum and of a step.
void set_pattern(const HemisphereSettings& s, hemisphere::Frame* f) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < s.samples; ++i) {
    f->cosine[i] = static_cast<float>(std::cos(golden * i));
    f->sine[i] = static_cast<float>(std::sin(golden * i));
    f->offset[i] = static_cast<float>(std::fmod(i * 0.75487766624669276, 1.0));
  }
  const int m = s.interleave, cells = m * m;
  Random random(s.seed);
  const std::vector<int> turns = shuffled(cells, &random), shifts = shuffled(cells, &random);
  const std::vector<int> offsets = shuffled(cells, &random);
  for (int cell = 0; cell < cells; ++cell) {
    const double turn = 2 * std::numbers::pi * (turns[cell] + 0.5) / cells;
    const double shift = (shifts[cell] + 0.5) / cells;
    double values[hemisphere::kTileValues] = {};
    values[hemisphere::kTileCos] = std::cos(turn);
    values[hemisphere::kTileSin] = std::sin(turn);
    values[hemisphere::kTileShift] = shift;
    values[hemisphere::kTileOffset] = (offsets[cell] + 0.5) / cells;
    double cosine_sum = 0;
    for (int i = 0; i < s.samples; ++i) {
      const double z = 1 - (i + shift) / s.samples, r = std::sqrt(1 - z * z);
      const double w[3] = {r * std::cos(golden * i + turn), r * std::sin(golden * i + turn), z};
      cosine_sum += z;
      for (int k = 0; k < 3; ++k) {
        values[hemisphere::kTileMean + k] += w[k] / s.samples;
        values[hemisphere::kTileCosineMean + k] += w[k] * z;
      }
    }
    for (int k = 0; k < 3; ++k) values[hemisphere::kTileCosineMean + k] /= cosine_sum;
    values[hemisphere::kTileCosineSum] = cosine_sum;
    for (int v = 0; v < hemisphere::kTileValues; ++v) {
      for (int x = cell % m; x < hemisphere::kTileRow; x += m) {
        f->tile[v][cell / m][x] = static_cast<float>(values[v]);
      }
    }
  }
}

// Four images with margins: one set of sums.
struct Channels {
  AlignedImage<float> planes[kChannels];

  void resize(int width, int height) {
    for (auto& p : planes) {
      p.resize(width + 2 * kMargin, height);
      std::fill_n(p.data(), p.stride() * height, 0.0f);
    }
  }
  float* row(int c, int y) { return planes[c].row(y) + kMargin; }
};

class HemisphereMethod final : public Method {
 public:
  HemisphereMethod(const HemisphereSettings& settings, int width, int height)
      : settings_(settings) {
    frame_.radius = std::clamp(settings.falloff.radius, 1e-30f, 1e30f);
    frame_.quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
    if (settings.occluder.kind == OccluderKind::kThickness) {
      frame_.thickness = settings.occluder.thickness;
    }
    frame_.samples = settings.samples;
    frame_.tests = settings.steps + 1;
    frame_.interleave = settings.interleave;
    set_pattern(settings, &frame_);
    if (settings.radiance) set_light();
    sums_.resize(width, height);
    if (settings.blur && settings.interleave > 1) {
      rows_.resize(width, height);
      normals_.resize(width, height);
      surface_.resize(width + 2 * kMargin, height);
      std::fill_n(surface_.data(), surface_.stride() * height, 0.0f);
    }
  }

  view::Needs needs() const override { return {.normals = true}; }
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
      if (Status s = pass(g, part, kUniform, directions, context); !s.ok()) return s;
    }
    if (!left.visibility.empty() || !o.cosine_integral.empty()) {
      Outputs part;
      part.visibility = left.visibility;
      part.cosine_integral = o.cosine_integral;
      if (Status s = pass(g, part, kCosine, !o.cosine_integral.empty(), context); !s.ok()) return s;
    }
    if (o.radiance.empty()) return {};
    Outputs part;
    part.radiance = o.radiance;
    return pass(g, part, kRadiance, true, context);
  }

 private:
  enum Kind { kUniform, kCosine, kRadiance };

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

  template <class Body>  // body(y)
  static void for_rows(int height, const RunContext& context, const Body& body) {
    context.executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
      const int end = std::min(height, (task + 1) * kRowsPerTask);
      for (int y = task * kRowsPerTask; y < end; ++y) body(y);
    });
  }

  // Sums of one kind, their blur, and the results that come from them.
  Status pass(const view::Geometry& g, const Outputs& o, Kind kind, bool directions,
              const RunContext& context) {
    const int width = g.visible_width(), height = g.visible_height();
    const int channels = directions ? kChannels : 1;
    Progress progress(height, context.progress);
    for_rows(height, context, [&](int y) {
      if (progress.cancelled()) return;
      hemisphere::Sums sums;
      float** to = kind == kUniform ? sums.uniform : kind == kCosine ? sums.cosine : sums.radiance;
      for (int c = 0; c < (kind == kRadiance ? 3 : channels); ++c) to[c] = sums_.row(c, y);
      hemisphere::sum_row(frame_, y, width, sums);
      // Whole vectors were written; what the blur meets beyond the row counts nothing, if finite.
      for (int c = 0; c < channels; ++c) std::fill_n(sums_.row(c, y) + width, kMargin, 0.0f);
      progress.advance();
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    if (settings_.blur && settings_.interleave > 1) blur(g, channels, context);
    for_rows(height, context, [&](int y) { finish(g, o, kind, directions, y); });
    return {};
  }

  // Taps up to half the tile away, the outermost with half the weight: each pixel of the tile
  // counts the same.
  void blur(const view::Geometry& g, int channels, const RunContext& context) {
    const int width = g.visible_width(), height = g.visible_height();
    const int m = settings_.interleave, reach = m / 2;
    hemisphere::BlurRow shared;
    shared.channels = channels;
    shared.orthographic = g.camera.orthographic;
    shared.edge = 0.5f * frame_.radius;
    for (int k = 0; k <= reach; ++k) shared.weights[k] = m % 2 == 0 && k == reach ? 0.5f : 1.0f;
    auto set_row = [&](hemisphere::BlurRow* row, Channels* from, Channels* to, int y) {
      for (int c = 0; c < channels; ++c) {
        row->values[c] = from->row(c, y);
        row->out[c] = to->row(c, y);
      }
      row->surface = surface_.row(y) + kMargin;
      for (int k = 0; k < 3; ++k) row->normal[k] = normals_.row(k, y);
    };
    for_rows(height, context, [&](int y) {
      float* surface = surface_.row(y) + kMargin;
      surface_row(g.depth.row(y + g.guard_band.top) + g.guard_band.left, width,
                  g.camera.orthographic, surface);
      std::fill_n(surface + width, kMargin, 0.0f);
      const std::ptrdiff_t at = (g.guard_band.top + y) * g.depth.stride() + g.guard_band.left;
      for (int k = 0; k < 3; ++k) std::copy_n(frame_.normal[k] + at, width, normals_.row(k, y));
      hemisphere::BlurRow row = shared;
      set_row(&row, &sums_, &rows_, y);
      row.first_tap = -reach;
      row.last_tap = reach;
      hemisphere::blur_row(row, width);
    });
    for_rows(height, context, [&](int y) {
      hemisphere::BlurRow row = shared;
      set_row(&row, &rows_, &sums_, y);
      row.value_step = rows_.planes[0].stride();
      row.surface_step = surface_.stride();
      row.normal_step = normals_.planes[0].stride();
      row.first_tap = -std::min(reach, y);
      row.last_tap = std::min(reach, height - 1 - y);
      hemisphere::blur_row(row, width);
    });
  }

  void finish(const view::Geometry& g, const Outputs& o, Kind kind, bool directions, int y) {
    const int width = g.visible_width();
    const bool cosine = kind == kCosine;
    if (kind == kRadiance) {
      const ImageView<float>* to[] = {&o.radiance.x, &o.radiance.y, &o.radiance.z};
      for (int c = 0; c < 3; ++c) {
        const float* from = sums_.row(c, y);
        for (int x = 0; x < width; ++x) (*to[c])(x, y) = from[x];
      }
      return;
    }
    // Results replace the sums, row by row, in blocks that leave room for what is still to be read.
    constexpr int kBlock = 256;
    float block[8][kBlock];
    const std::ptrdiff_t at = (g.guard_band.top + y) * g.depth.stride() + g.guard_band.left;
    for (int x = 0; x < width; x += kBlock) {
      const int count = std::min(kBlock, width - x);
      const float* sums[kChannels] = {};
      for (int c = 0; c < (directions ? kChannels : 1); ++c) sums[c] = sums_.row(c, y) + x;
      const float* normal[3] = {frame_.normal[0] + at + x, frame_.normal[1] + at + x,
                                frame_.normal[2] + at + x};
      const VectorView<float>& integral = cosine ? o.cosine_integral : o.uniform_integral;
      hemisphere::Results r;
      r.visibility = block[0];
      r.angle = o.cone_angle.empty() ? nullptr : block[1];
      for (int k = 0; k < 3; ++k) {
        r.direction[k] = o.bent_normal.empty() ? nullptr : block[2 + k];
        r.integral[k] = integral.empty() ? nullptr : block[5 + k];
      }
      cosine ? hemisphere::finish_cosine_row(sums, normal, count, r)
             : hemisphere::finish_uniform_row(sums, normal, settings_.cone == ConeEstimate::kPaper,
                                              count, r);
      auto copy = [&](const ImageView<float>& to, const float* from) {
        if (to.empty()) return;
        for (int i = 0; i < count; ++i) to(x + i, y) = from[i];
      };
      copy(o.visibility, block[0]);
      copy(o.cone_angle, block[1]);
      copy(o.bent_normal.x, block[2]), copy(o.bent_normal.y, block[3]);
      copy(o.bent_normal.z, block[4]);
      copy(integral.x, block[5]), copy(integral.y, block[6]), copy(integral.z, block[7]);
    }
  }

  const HemisphereSettings settings_;
  hemisphere::Frame frame_;
  Channels sums_, rows_, normals_;
  AlignedImage<float> surface_;
  std::vector<float> light_[3];
};

}  // namespace

Status make_hemisphere(const HemisphereSettings& settings, int width, int height,
                       std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  *method = std::make_unique<HemisphereMethod>(settings, width, height);
  return {};
}

}  // namespace obscura
