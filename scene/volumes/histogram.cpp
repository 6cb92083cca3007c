#include "scene/volumes/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura::tools {
namespace {

constexpr int kBins = 256;

template <class F>
void for_values(const VolumeImage& image, const F& f) {
  const VolumeView view = image.view();
  std::vector<float> row(std::size_t(view.size[0]));
  for (int z = 0; z < view.size[2]; ++z) {
    for (int y = 0; y < view.size[1]; ++y) {
      volume_row(view, y, z, row.data());
      for (float v : row) f(v);
    }
  }
}

}  // namespace

Status make_histogram(const VolumeImage& image, Histogram* histogram) {
  Histogram h;
  h.min = INFINITY;
  h.max = -INFINITY;
  double sum = 0;
  for_values(image, [&](float v) {
    if (!std::isfinite(v)) {
      ++(std::isnan(v) ? h.nan : h.infinite);
      return;
    }
    ++h.finite;
    sum += v;
    h.min = std::min(h.min, double{v});
    h.max = std::max(h.max, double{v});
  });
  if (h.finite == 0) {
    return invalid_input(fmt::format("{}: has no finite value", image.name));
  }
  h.mean = sum / double(h.finite);
  const double step = image.type == VoxelType::kF32 ? 0 : std::abs(double{image.slope});
  if (step > 0 && (h.max - h.min) / step < kBins) {
    h.width = step;
    h.first = h.min - step / 2;
    h.bins.resize(std::size_t(std::lround((h.max - h.min) / step)) + 1);
  } else {
    h.width = h.max > h.min ? (h.max - h.min) / kBins : 1;
    h.first = h.min;
    h.bins.resize(h.max > h.min ? kBins : 1);
  }
  const auto last = std::int64_t(h.bins.size()) - 1;
  for_values(image, [&](float v) {
    if (!std::isfinite(v)) return;
    const auto bin = static_cast<std::int64_t>((v - h.first) / h.width);
    ++h.bins[std::size_t(std::clamp<std::int64_t>(bin, 0, last))];
  });
  *histogram = std::move(h);
  return {};
}

Status otsu_threshold(const VolumeImage& image, const Histogram& h, double* threshold) {
  if (!(h.max > h.min)) {
    return invalid_input(
        fmt::format("{}: all its values are {}; no isovalue parts them", image.name, h.min));
  }
  double total = 0;
  for (std::size_t i = 0; i < h.bins.size(); ++i) total += double(h.bins[i]) * (double(i) + 0.5);
  double below = 0, sum = 0, best = -1;
  std::size_t first = 1, last = 1;
  for (std::size_t i = 1; i < h.bins.size(); ++i) {
    below += double(h.bins[i - 1]);
    sum += double(h.bins[i - 1]) * (double(i) - 0.5);
    const double above = double(h.finite) - below;
    if (below == 0 || above == 0) continue;
    const double apart = sum / below - (total - sum) / above;
    const double between = below * above * apart * apart;
    // A gap between the classes gives several equal maxima; the threshold is the middle of them.
    if (between > best * (1 + 1e-12)) {
      best = between;
      first = last = i;
    } else if (h.bins[i - 1] == 0 && last == i - 1) {
      last = i;
    }
  }
  *threshold = h.first + h.width * 0.5 * double(first + last);
  return {};
}

}  // namespace obscura::tools
