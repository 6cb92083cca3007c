// obscura compare: how an image differs from a reference.
#include <cstdio>
#include <memory>
#include <vector>

#include "apps/obscura/app.h"
#include "apps/obscura/output.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/pictures/pictures.h"
#include "scene/truth/compare.h"

namespace obscura::app {
namespace {

struct CompareCommand {
  std::string image, reference, mask, channel, error_image, json;
  bool allow_nan = false, quiet = false;
};

// The channels to compare: those asked for, else visibility, else all that both images have.
Status choose_channels(const tools::Image& a, const tools::Image& b, const std::string& wanted,
                       std::vector<std::pair<int, int>>* pairs) {
  std::string names_a, names_b;
  for (int i = 0; i < static_cast<int>(a.channels.size()); ++i) {
    names_a += " " + a.channels[i].name;
    for (int j = 0; j < static_cast<int>(b.channels.size()); ++j) {
      if (a.channels[i].name != b.channels[j].name) continue;
      if (!wanted.empty() && a.channels[i].name != wanted) continue;
      pairs->emplace_back(i, j);
    }
  }
  for (const auto& c : b.channels) names_b += " " + c.name;
  if (wanted.empty()) {
    if (a.channels.size() == 1 && b.channels.size() == 1) *pairs = {{0, 0}};
    for (const auto& pair : *pairs) {
      if (a.channels[pair.first].name == "visibility") {
        *pairs = {pair};
        break;
      }
    }
    // A lone channel, whatever its name in that file format, against a visibility channel.
    auto lone = [&](const tools::Image& many, const tools::Image& one, bool swap) {
      if (!pairs->empty() || one.channels.size() != 1) return;
      for (int i = 0; i < static_cast<int>(many.channels.size()); ++i) {
        if (many.channels[i].name != "visibility") continue;
        pairs->push_back(swap ? std::pair{0, i} : std::pair{i, 0});
      }
    };
    lone(a, b, false);
    lone(b, a, true);
  }
  if (!pairs->empty()) return {};
  return invalid_input(fmt::format("no channel{} in both images: the first has{}, the second has{}",
                                   wanted.empty() ? "" : " '" + wanted + "'", names_a, names_b));
}

// The visible part of a depth image that may have a guard band around it.
Status crop_mask(const tools::Image& depth, int width, int height, ImageView<const float>* mask) {
  int channel = 0;
  for (int i = 0; i < static_cast<int>(depth.channels.size()); ++i) {
    if (depth.channels[i].name == "Z") channel = i;
  }
  const int dx = depth.width - width, dy = depth.height - height;
  if (dx < 0 || dy < 0 || dx % 2 != 0 || dy % 2 != 0) {
    return invalid_input(fmt::format(
        "--mask is {}x{}; it must have the first image's size, {}x{}, or a guard band around it",
        depth.width, depth.height, width, height));
  }
  const auto full = depth.view(channel);
  *mask = {full.data + dy / 2 * full.row_stride + dx / 2, width, height, full.row_stride};
  return {};
}

Status run_compare(const CompareCommand& c) {
  tools::Image a, b, depth;
  if (Status s = tools::read_image(c.image, &a); !s.ok()) return s;
  if (Status s = tools::read_image(c.reference, &b); !s.ok()) return s;
  std::vector<std::pair<int, int>> pairs;
  if (Status s = choose_channels(a, b, c.channel, &pairs); !s.ok()) return s;
  ImageView<const float> mask;
  if (!c.mask.empty()) {
    if (Status s = tools::read_image(c.mask, &depth); !s.ok()) return s;
    if (Status s = crop_mask(depth, a.width, a.height, &mask); !s.ok()) return s;
  }
  tools::Report report;
  report.settings = {{"image", c.image}, {"reference", c.reference}, {"mask", c.mask}};
  if (!a.occluder.empty()) report.settings["image_occluder"] = a.occluder;
  if (!b.occluder.empty()) report.settings["reference_occluder"] = b.occluder;
  if (!a.occluder.empty() && !b.occluder.empty() && a.occluder != b.occluder) {
    fmt::print(stderr,
               "obscura: note: two models of matter: the image's occluder is {}, the "
               "reference's {}\n",
               a.occluder, b.occluder);
  }
  std::string nan;
  for (const auto& [i, j] : pairs) {
    tools::Comparison r;
    const std::string& name = a.channels[i].name;
    if (Status s = tools::compare(a.view(i), b.view(j), mask, &r); !s.ok()) {
      return invalid_input(fmt::format("{}: {}", name, s.message()));
    }
    report.add(name, "e_A", r.e_a, "%");
    report.add(name, "e_<5%", r.within_5, "%");
    report.add(name, "bias", r.bias, "%");
    report.add(name, "RMSE", r.rmse, "%");
    report.add(name, "maximum", r.maximum, "%");
    report.add(name, "correlation", r.correlation);
    report.add(name, "pixels", static_cast<double>(r.pixels));
    report.add(name, "infinite in one only", static_cast<double>(r.infinite));
    report.add(name, "NaN", static_cast<double>(r.nan));
    if (r.nan > 0) {
      nan += fmt::format("{}{}: {} of {} pixels are NaN (in the first image {}, in the second {})",
                         nan.empty() ? "" : "; ", name, r.nan, r.nan + r.infinite + r.pixels,
                         r.nan_image, r.nan_reference);
    }
    if (r.infinite > 0) {
      fmt::print(stderr, "obscura: note: {}: {} pixels are infinite in one image only, left out\n",
                 name, r.infinite);
    }
    if (!c.quiet && c.json != "-") {
      fmt::print(
          "{}: e_A {:.3f} %  e_<5% {:.2f} %  bias {:+.3f} %  RMSE {:.3f} %  maximum {:.2f} %"
          "  correlation {:.4f}  ({} pixels)\n",
          name, r.e_a, r.within_5, r.bias, r.rmse, r.maximum, r.correlation, r.pixels);
    }
  }
  if (!c.error_image.empty()) {
    const tools::Image picture =
        tools::error_picture(a.view(pairs[0].first), b.view(pairs[0].second), mask);
    if (Status s = tools::write_image(c.error_image, picture); !s.ok()) return s;
  }
  if (Status s = write_json(report, c.json); !s.ok() || nan.empty()) return s;
  if (c.allow_nan) {
    fmt::print(stderr, "obscura: note: {}, left out\n", nan);
    return {};
  }
  return invalid_input(nan +
                       "; the figures are of the others; --mask DEPTH leaves pixels out, "
                       "--allow-nan those that are NaN");
}

}  // namespace

void add_compare(App& app) {
  auto c = std::make_shared<CompareCommand>();
  CLI::App* command = app.add_command(
      "compare",
      "How image A differs from reference B. Where B is N times smaller, A is read at every N-th "
      "pixel from floor(N/2). Equal infinities are equal, one-sided ones are counted. NaN is "
      "counted and never taken for equal: the exit code is then not 0.",
      [c, &app] {
        c->quiet = app.quiet;
        return run_compare(*c);
      });
  command->add_option("A", c->image, "Image: EXR, PFM or PNG")->required()->type_name("FILE");
  command->add_option("B", c->reference, "Reference")->required()->type_name("FILE");
  command->add_option("--mask", c->mask, "Depth image; pixels without a finite depth are left out")
      ->type_name("DEPTH");
  command->add_flag("--allow-nan", c->allow_nan,
                    "Leave NaN pixels out with a note, such as those between the pixels of a "
                    "reference made with --every");
  command->add_option("--channel", c->channel, "Compare this channel [visibility, else all common]")
      ->type_name("NAME");
  command
      ->add_option("--error-image", c->error_image,
                   "Write the error as a picture: white 0 %, black 20 % and more")
      ->type_name("FILE.png");
  command->add_option("--json", c->json, "Write the figures as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
