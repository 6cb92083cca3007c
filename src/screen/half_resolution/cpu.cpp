#include "screen/half_resolution/half_resolution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "filters/bilateral/kernel.h"
#include "filters/upsampling/kernel.h"
#include "view/half.h"

namespace obscura {
namespace {

constexpr int kRowsPerTask = 8;  // of the half image
constexpr int kRows = 2 * kRowsPerTask + 1;
constexpr int kMargin = 16;  // left and right of rows: kernels read and write whole vectors

using view::HalfAxis;

void halve(const AlignedImage<float>& from, const HalfAxis& x, const HalfAxis& y,
           Executor& executor, AlignedImage<float>* to) {
  to->resize(x.size, y.size);
  executor.parallel_for(y.size, [&](int row, int) {
    const float* source = from.row(y.first + 2 * row) + x.first;
    float* target = to->row(row);
    for (int i = 0; i < x.size; ++i) target[i] = source[2 * i];
  });
}

void halve(const view::Geometry& g, Executor& executor, view::Geometry* half) {
  const GuardBand& guard = g.guard_band;
  const HalfAxis x = view::halve(g.width, guard.left, g.visible().width);
  const HalfAxis y = view::halve(g.height, guard.top, g.visible().height);
  half->width = x.size;
  half->height = y.size;
  half->guard_band = {x.before, x.after(), y.before, y.after()};
  half->camera = view::halve(g.camera, x, y);
  half->has_normals = g.has_normals;
  halve(g.depth, x, y, executor, &half->depth);
  view::find_depth_range(executor, half);
  if (g.has_normals) {
    halve(g.normal_x, x, y, executor, &half->normal_x);
    halve(g.normal_y, x, y, executor, &half->normal_y);
    halve(g.normal_z, x, y, executor, &half->normal_z);
  }
  if (!g.back_depth.empty()) halve(g.back_depth, x, y, executor, &half->back_depth);
  half->layers.resize(g.layers.size());
  for (std::size_t i = 0; i < g.layers.size(); ++i) {
    halve(g.layers[i].front, x, y, executor, &half->layers[i].front);
    halve(g.layers[i].back, x, y, executor, &half->layers[i].back);
  }
}

// One image of the results.
struct Channel {
  ImageView<float> to;
  float open = 0;         // where nothing is near, of the difference
  int axis = 0;           // of a vector
  float normal_part = 0;  // times the normal is what is not blurred
  bool unit = false;      // first of three channels that make a unit vector
};

// The channels that `outputs` asks for. In order: visibility stays in [0, 1].
std::vector<Channel> channels_of(const Outputs& o) {
  std::vector<Channel> channels;
  auto scalar = [&](const ImageView<float>& to, float open) {
    if (!to.empty()) channels.push_back({.to = to, .open = open});
  };
  auto vector = [&](const VectorView<float>& to, float normal_part, bool unit) {
    const ImageView<float>* axes[] = {&to.x, &to.y, &to.z};
    for (int k = 0; k < 3 && !to.empty(); ++k) {
      channels.push_back(
          {.to = *axes[k], .axis = k, .normal_part = normal_part, .unit = unit && k == 0});
    }
  };
  scalar(o.visibility, 1);
  scalar(o.cone_angle, 1.57079633f);
  scalar(o.standard_error, 0);
  vector(o.bent_normal, 1, true);
  vector(o.uniform_integral, 1, false);
  vector(o.cosine_integral, 2.0f / 3, false);
  vector(o.radiance, 0, false);
  return channels;
}

}  // namespace

class HalfResolution final : public Method {
 public:
  explicit HalfResolution(std::unique_ptr<Method> method) : method_(std::move(method)) {}

  view::Needs needs() const override { return method_->needs(); }
  OutputKinds output_kinds() const override { return method_->output_kinds(); }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    context.timer.time("halve", [&] { halve(g, context.executor, &half_); });
    const std::vector<Channel> channels = channels_of(outputs);
    if (Status s = method_->run(half_, inner(outputs), context); !s.ok()) return s;
    context.timer.time("fill in", [&] { fill_in(g, channels, context.executor); });
    return {};
  }

 private:
  // Rows of one task: a plane of them after the other.
  struct Rows {
    AlignedImage<float> memory;

    void resize(int width, int planes) {
      memory.resize(width + 3 * kMargin, planes * kRows);
      std::fill_n(memory.data(), memory.stride() * planes * kRows, 0.0f);
    }
    float* row(int plane, int y) { return memory.row(plane * kRows + y) + kMargin; }
  };
  static constexpr int kNormalPlane = 1, kValuePlane = 4;  // after the surface

  // The images of half the size that go with `outputs`, in the order of channels_of().
  Outputs inner(const Outputs& outputs) {
    Outputs result;
    std::size_t next = 0;
    auto image = [&](const ImageView<float>& of) -> ImageView<float> {
      if (of.empty()) return {};
      if (next == images_.size()) images_.emplace_back();
      AlignedImage<float>& image = images_[next++];
      image.resize(half_.visible().width, half_.visible().height);
      return image.view();
    };
    auto vector = [&](const VectorView<float>& of) -> VectorView<float> {
      const ImageView<float> x = image(of.x), y = image(of.y), z = image(of.z);
      return {x, y, z};
    };
    result.visibility = image(outputs.visibility);
    result.cone_angle = image(outputs.cone_angle);
    result.standard_error = image(outputs.standard_error);
    result.bent_normal = vector(outputs.bent_normal);
    result.uniform_integral = vector(outputs.uniform_integral);
    result.cosine_integral = vector(outputs.cosine_integral);
    result.radiance = vector(outputs.radiance);
    return result;
  }

  void fill_in(const view::Geometry& g, const std::vector<Channel>& channels, Executor& executor) {
    const int width = g.visible().width, height = g.visible().height;
    rows_.resize(std::max<std::size_t>(rows_.size(), executor.thread_count()));
    for (Rows& rows : rows_) {
      rows.resize(width, kValuePlane + static_cast<int>(channels.size()));
    }
    const int tasks = (half_.visible().height + kRowsPerTask - 1) / kRowsPerTask;
    executor.parallel_for(tasks, [&](int task, int worker) {
      const int first = 2 * kRowsPerTask * task;  // row of the visible part
      const int below = std::min(height, first + kRows);
      const int end = std::min(height, first + kRows - 1);
      Rows& rows = rows_[worker];
      for (int y = first; y < below; ++y) load(g, y, y - first, &rows);
      for (int y = first; y < below; y += 2) fill_row(g, channels, y, y - first, &rows);
      for (int y = first + 1; y < end; y += 2) {
        fill_between_rows(g, channels, y, y - first, &rows);
      }
      for (int y = first; y < end; ++y) write(channels, width, y, y - first, &rows);
    });
  }

  static void load(const view::Geometry& g, int y, int to, Rows* rows) {
    const int width = g.visible().width, row = g.guard_band.top + y, left = g.guard_band.left;
    float* surface = rows->row(0, to);
    surface_row(g.depth.row(row) + left, width, g.camera.orthographic, surface);
    std::fill_n(surface + width, kMargin, 0.0f);
    if (!g.has_normals) return;
    const AlignedImage<float>* normals[] = {&g.normal_x, &g.normal_y, &g.normal_z};
    for (int k = 0; k < 3; ++k) {
      std::copy_n(normals[k]->row(row) + left, width, rows->row(kNormalPlane + k, to));
    }
  }

  static UpsamplingRow shared_row(const view::Geometry& g, const std::vector<Channel>& channels,
                                  float pixel, int at, Rows* rows) {
    UpsamplingRow row;
    row.channels = static_cast<int>(channels.size());
    row.orthographic = g.camera.orthographic;
    row.edge = kUpsamplingEdge * pixel;
    row.surface = rows->row(0, at);
    for (int k = 0; k < 3 && g.has_normals; ++k) row.normal[k] = rows->row(kNormalPlane + k, at);
    for (int c = 0; c < row.channels; ++c) {
      row.values[c] = row.out[c] = rows->row(kValuePlane + c, at);
      row.open[c] = channels[c].open;
    }
    return row;
  }

  // A row that the method has seen: every second pixel is known.
  void fill_row(const view::Geometry& g, const std::vector<Channel>& channels, int y, int at,
                Rows* rows) {
    const int width = g.visible().width;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const float* known = images_[c].row(y / 2);
      const float* normal = rows->row(kNormalPlane + channels[c].axis, at);
      const float part = channels[c].normal_part;
      float* values = rows->row(kValuePlane + static_cast<int>(c), at);
      for (int i = 0; i < half_.visible().width; ++i) {
        values[2 * i] = known[i] - part * normal[2 * i];
      }
    }
    UpsamplingRow row = shared_row(g, channels, g.camera.scale_x, at, rows);
    row.odd_only = true;
    upsample_row(row, width);
  }

  static void fill_between_rows(const view::Geometry& g, const std::vector<Channel>& channels,
                                int y, int at, Rows* rows) {
    UpsamplingRow row = shared_row(g, channels, g.camera.scale_y, at, rows);
    row.value_step = row.surface_step = row.normal_step = rows->memory.stride();
    row.after = y + 1 < g.visible().height;
    upsample_row(row, g.visible().width);
  }

  // Differences become results.
  static void write(const std::vector<Channel>& channels, int width, int y, int at, Rows* rows) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Channel& channel = channels[c];
      float* values = rows->row(kValuePlane + static_cast<int>(c), at);
      const float* normal = rows->row(kNormalPlane + channel.axis, at);
      for (int x = 0; x < width; ++x) values[x] += channel.normal_part * normal[x];
    }
    for (std::size_t c = 0; c < channels.size(); ++c) {
      float* value[3] = {};
      for (int k = 0; k < (channels[c].unit ? 3 : 0); ++k) {
        value[k] = rows->row(kValuePlane + static_cast<int>(c) + k, at);
      }
      for (int x = 0; x < width && channels[c].unit; ++x) {
        const float a = value[0][x], b = value[1][x], d = value[2][x];
        const float scale = 1 / std::sqrt(std::max(a * a + b * b + d * d, 1e-30f));
        for (float* v : value) v[x] *= scale;
      }
      const ImageView<float>& to = channels[c].to;
      const float* values = rows->row(kValuePlane + static_cast<int>(c), at);
      for (int x = 0; x < width; ++x) to(x, y) = values[x];
    }
  }

  std::unique_ptr<Method> method_;
  view::Geometry half_;
  std::vector<AlignedImage<float>> images_;
  std::vector<Rows> rows_;  // one per thread
};

std::unique_ptr<Method> make_half_resolution(std::unique_ptr<Method> method) {
  return std::make_unique<HalfResolution>(std::move(method));
}

}  // namespace obscura
