// A picture of obscura volume, of a sequence or alone.
#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/obscura/volume_command.h"
#include "fmt/format.h"
#include "io/report/stopwatch.h"
#include "io/sequences/frame_names.h"
#include "scene/volumes/histogram.h"

namespace obscura::app {
namespace {

// The isovalue and side: as given, else the volume's own, else Otsu's threshold.
Status choose_isovalue(const VolumeCommand& c, const tools::VolumeImage& image, bool quiet,
                       DistanceSettings* distance) {
  if (!c.table.given("solid") && image.solid) distance->solid = *image.solid;
  if (c.table.given("iso")) return {};
  const char* why = "the volume's own";
  if (image.isovalue) {
    distance->isovalue = *image.isovalue;
  } else {
    tools::Histogram histogram;
    double threshold = 0;
    if (Status s = tools::make_histogram(image, &histogram); !s.ok()) return s;
    if (Status s = tools::otsu_threshold(image, histogram, &threshold); !s.ok()) return s;
    distance->isovalue = float(threshold);
    why = "Otsu's threshold; choose another by --iso";
  }
  if (!quiet && c.json != "-") fmt::print("isovalue {:g} ({})\n", distance->isovalue, why);
  return {};
}

// A refused isovalue, named as the user gave it.
Status named_by_option(const Status& s, const char* option, const OptionTable& table) {
  const bool outer = std::string_view(option) != "--iso";
  const bool isovalue = s.message().starts_with("isovalue") && (outer || table.given("iso"));
  return isovalue ? Status(s.code(), fmt::format("{}: {}", option, s.message())) : s;
}

// The outer surface must have more matter than the inner one.
Status check_outer(const VolumeSettings& settings) {
  const std::optional<float>& outer = settings.picture.outer.isovalue;
  const DistanceSettings& inner = settings.distance;
  const bool above = inner.solid == SolidSide::kAbove;
  if (!outer || (above ? *outer < inner.isovalue : *outer > inner.isovalue)) return {};
  return invalid_argument(
      fmt::format("--outer-iso is {:g}; it must be {} the inner isovalue, {:g}, to lie around it",
                  *outer, above ? "less than" : "greater than", inner.isovalue));
}

// What is said where no ray meets the surface: of a camera that was placed, where the volume lies.
Status misses_the_surface(const VolumeCommand& c, const tools::VolumeImage& image) {
  if (!c.table.given("eye") && !c.table.given("look_at")) {
    tools::Histogram values;
    if (Status s = tools::make_histogram(image, &values); !s.ok()) return s;
    return invalid_input(fmt::format(
        "{}: its surface is so small that it lies between the pixels; choose another --iso or a "
        "larger --size{}",
        image.name,
        values.nan > 0 ? ", or clip its NaN, at which surfaces end, away by --clip" : ""));
  }
  tools::Double3 low, high;
  low.fill(INFINITY);
  high.fill(-INFINITY);
  const tools::Double3 h = image.spacing();
  for (int corner = 0; corner < 8; ++corner) {
    tools::Double3 p;
    for (int a = 0; a < 3; ++a) p[a] = corner >> a & 1 ? (image.size[a] - 1) * h[a] : 0;
    const tools::Double3 world = image.to_world(p);
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], world[a]);
      high[a] = std::max(high[a], world[a]);
    }
  }
  return invalid_argument(fmt::format(
      "the picture misses the surface; --eye and --look-at must show a part of the volume, which "
      "reaches from {:g},{:g},{:g} to {:g},{:g},{:g}",
      low[0], low[1], low[2], high[0], high[1], high[2]));
}

// Distances, light and pictures of one isosurface.
struct VolumeLayer {
  DistanceSettings settings;
  std::vector<float> distances;
  tools::VolumeShading shading;
  VolumePictures pictures;

  GridView<float> grid(const tools::VolumeImage& image) {
    return {distances.data(), image.size, image.view().spacing};
  }
};

class VolumeFrame : public CommandFrame {
 public:
  VolumeFrame(const VolumeCommand& command, const VolumeRequest& request, Executor* executor,
              bool quiet, FrameFiles files)
      : c_(command),
        p_(request),
        settings_(request.settings),
        executor_(executor),
        quiet_(quiet),
        files_(std::move(files)),
        picture_(c_.output.empty() ? "" : files_.output),
        fields_(files_.number ? tools::name_of_frame(c_.fields, *files_.number) : c_.fields) {}

  Status read() override { return c_.volume.load(files_.input, c_.threads, &image_); }

  Status compute(const std::function<bool(double)>& progress) override {
    if (Status s = choose_isovalue(c_, image_, quiet_, &settings_.distance); !s.ok()) return s;
    if (Status s = check_outer(settings_); !s.ok()) return s;
    const std::optional<float>& outer_isovalue = settings_.picture.outer.isovalue;
    // Steps of equal parts of the bar: three, of two surfaces seven.
    const int steps = outer_isovalue ? 7 : 3;
    int step = 0;
    auto stage = [&](double* milliseconds, auto&& work) {
      const tools::Stopwatch watch;
      RunOptions run;
      run.executor = executor_;
      run.progress = [&](double share) { return progress((step + share) / steps); };
      const Status s = work(run);
      ++step;
      *milliseconds += 1e3 * watch.seconds();
      return s;
    };
    auto measure = [&](VolumeLayer& layer) {
      layer.distances.resize(std::size_t(image_.voxels()));
      return stage(&distance_ms_, [&](const RunOptions& run) {
        return sweep_distance(image_.view(), layer.settings, layer.grid(image_), run);
      });
    };
    inner_.settings = outer_.settings = settings_.distance;
    if (Status s = measure(inner_); !s.ok()) return named_by_option(s, "--iso", c_.table);
    if (outer_isovalue) {
      outer_.settings.isovalue = *outer_isovalue;
      if (Status s = measure(outer_); !s.ok()) return named_by_option(s, "--outer-iso", c_.table);
    }
    SurfaceCamera camera;
    RunOptions with_threads;
    with_threads.executor = executor_;
    VolumeLayer& framed = outer_isovalue ? outer_ : inner_;
    if (Status s =
            tools::place_camera(image_, framed.grid(image_), settings_.view, &camera, with_threads);
        !s.ok()) {
      return s;
    }
    tools::VolumeTruth truth;
    truth.monte_carlo = settings_.picture.method == VolumeMethod::kMonteCarlo;
    truth.settings = settings_.monte_carlo;
    for (VolumeLayer* layer : {&inner_, &outer_}) {
      if (layer == &outer_ && !outer_isovalue) continue;
      const Status s = stage(&light_ms_, [&](const RunOptions& run) {
        return layer->shading.prepare(image_, layer->grid(image_), p_.light, settings_.occlusion,
                                      truth, run);
      });
      if (!s.ok()) return s;
    }
    if (!picture_.empty()) {
      auto render = [&](VolumeLayer& layer, const SurfaceShader& shader,
                        const SurfaceOutputs& outputs) {
        return stage(&render_ms_, [&](const RunOptions& run) {
          return render_surface(
              {image_.view(), layer.settings.isovalue, layer.settings.solid, layer.grid(image_)},
              camera, settings_.surface, shader, outputs, run);
        });
      };
      for (VolumeLayer* layer : {&inner_, &outer_}) {
        if (layer == &outer_ && !outer_isovalue) continue;
        VolumePictures& to = layer->pictures;
        to.allocate(settings_.view.size.width, settings_.view.size.height);
        const Status s = render(*layer, layer->shading.shader(camera),
                                {to.visibility.view(0), to.coverage.view(0), to.depth.view(0)});
        if (!s.ok()) return s;
      }
      if (outer_isovalue) {
        const Status s =
            render(outer_, tools::camera_lamp(camera), {outer_.pictures.facing.view(0)});
        if (!s.ok()) return s;
      }
      mean_ = mean_visibility(framed.pictures);
      if (std::isnan(mean_)) return misses_the_surface(c_, image_);
    }
    size_ = image_.size;
    if (!c_.fields.empty()) return {};
    // A volume is large, and others are in memory at the same time.
    image_ = {};
    for (VolumeLayer* layer : {&inner_, &outer_}) {
      layer->distances = {};
      layer->shading = {};
    }
    return {};
  }

  Status write() override {
    if (!picture_.empty()) {
      tools::WriteOptions write;
      write.half = c_.half;
      write.made_by = files_.made_by;
      if (Status s =
              write_volume_picture(picture_, write, p_, std::move(inner_.pictures),
                                   settings_.picture.outer.isovalue ? &outer_.pictures : nullptr);
          !s.ok()) {
        return s;
      }
    }
    if (c_.fields.empty()) return {};
    RunOptions run;
    run.threads = 1;  // in a sequence, the others compute the next frame
    if (!files_.number) run.executor = executor_;
    return write_volume_fields(fields_, settings_.picture.fields_of, image_, inner_.distances,
                               inner_.shading.field(), run);
  }

  std::string line() const override {
    std::string text;
    if (!picture_.empty()) {
      text = fmt::format("{}: {}x{}, {}, {} {:.3f}, {:.2f} s", picture_, settings_.view.size.width,
                         settings_.view.size.height, p_.light_name, measured(), mean_, times.sum());
    }
    if (c_.fields.empty()) return text;
    return fmt::format("{}{}{}: {}", text, text.empty() ? "" : "\n", fields_,
                       enum_name(settings_.picture.fields_of));
  }

  tools::Report report() const override {
    tools::Report report;
    report.settings["input"] = files_.input;
    report.settings["light"] = p_.light_name;
    report.settings["clipped_size"] = size_;
    visit_fields(settings_, [&](const auto& value, const Field& field) {
      report.settings[field.name] = write_setting(value);
    });
    report.add(p_.light_name, "time to load", 1e3 * times.read, "ms");
    report.add(p_.light_name, "time of distances", distance_ms_, "ms");
    report.add(p_.light_name, "time of light sweeps", light_ms_, "ms");
    if (!picture_.empty()) {
      report.add(p_.light_name, "time to render", render_ms_, "ms");
      report.add(p_.light_name, measured(), mean_);
    }
    return report;
  }

 private:
  const char* measured() const { return p_.picture ? "mean light" : "mean visibility"; }

  const VolumeCommand& c_;
  const VolumeRequest& p_;
  VolumeSettings settings_;
  Executor* const executor_;
  const bool quiet_;
  const FrameFiles files_;
  const std::string picture_, fields_;  // "" where none is wanted
  tools::VolumeImage image_;
  std::array<int, 3> size_{};
  VolumeLayer inner_, outer_;
  double distance_ms_ = 0, light_ms_ = 0, render_ms_ = 0, mean_ = 0;
};

}  // namespace

std::unique_ptr<CommandFrame> make_volume_frame(const VolumeCommand& command,
                                                const VolumeRequest& request, Executor* executor,
                                                bool quiet, FrameFiles files) {
  return std::make_unique<VolumeFrame>(command, request, executor, quiet, std::move(files));
}

}  // namespace obscura::app
