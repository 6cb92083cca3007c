#include "scene/truth/compare.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"

namespace obscura::tools {

Status compare(const ImageView<const float>& image, const ImageView<const float>& reference,
               const ImageView<const float>& mask, Comparison* result) {
  if (image.width < 1 || image.height < 1 || reference.width < 1 || reference.height < 1) {
    return invalid_input("an image to compare is empty");
  }
  const int n = image.width / reference.width;
  if (n < 1 || image.width / n != reference.width || image.height / n != reference.height) {
    return invalid_input(fmt::format(
        "images are {}x{} and {}x{}; the second must have the first's size or be a whole number of "
        "times smaller",
        image.width, image.height, reference.width, reference.height));
  }
  if (!mask.empty() && (mask.width != image.width || mask.height != image.height)) {
    return invalid_input(fmt::format("mask is {}x{}; it must be {}x{} like the first image",
                                     mask.width, mask.height, image.width, image.height));
  }
  Comparison c;
  double sum = 0, sum_abs = 0, sum_square = 0;
  double ma = 0, mb = 0, saa = 0, sbb = 0, sab = 0;  // running moments (Welford)
  std::int64_t within = 0, finite = 0;
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const int u = x * n + n / 2, v = y * n + n / 2;
      const double a = image(u, v), b = reference(x, y);
      if (!mask.empty() && !std::isfinite(mask(u, v))) continue;
      if (std::isnan(a) || std::isnan(b)) {
        ++c.nan;
        c.nan_image += std::isnan(a);
        c.nan_reference += std::isnan(b);
        continue;
      }
      if (a != b && (std::isinf(a) || std::isinf(b))) {
        ++c.infinite;
        continue;
      }
      if (std::isinf(a)) {  // in both: no difference, and no moments
        ++c.pixels;
        ++within;
        continue;
      }
      const double d = a - b;
      ++finite;
      ++c.pixels;
      sum += d;
      sum_abs += std::abs(d);
      sum_square += d * d;
      within += std::abs(d) < 0.05;
      c.maximum = std::max(c.maximum, std::abs(d));
      const double k = 1.0 / static_cast<double>(finite);
      const double da = a - ma, db = b - mb;
      ma += da * k;
      mb += db * k;
      saa += da * (a - ma);
      sbb += db * (b - mb);
      sab += da * (b - mb);
    }
  }
  *result = c;
  if (c.pixels == 0 && c.nan > 0) {
    return invalid_input(fmt::format(
        "no pixel to compare: {} are NaN (in the first image {}, in the second {}), {} infinite in "
        "one image only",
        c.nan, c.nan_image, c.nan_reference, c.infinite));
  }
  if (c.pixels == 0 && c.infinite > 0) {
    return invalid_input(
        fmt::format("every pixel is infinite in one of the images only ({} pixels)", c.infinite));
  }
  if (c.pixels == 0) return invalid_input("the images have no pixel to compare");
  const double k = 100.0 / static_cast<double>(c.pixels);
  c.e_a = sum_abs * k;
  c.within_5 = static_cast<double>(within) * k;
  c.bias = sum * k;
  c.rmse = 100 * std::sqrt(sum_square / static_cast<double>(c.pixels));
  c.maximum *= 100;
  const double spread = std::sqrt(saa * sbb);
  c.correlation = spread > 0 ? sab / spread : (sum_abs == 0 ? 1 : 0);
  *result = c;
  return {};
}

}  // namespace obscura::tools
