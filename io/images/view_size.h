#ifndef OBSCURA_IO_IMAGES_VIEW_SIZE_H_
#define OBSCURA_IO_IMAGES_VIEW_SIZE_H_

#include <optional>

#include "obscura/camera.h"
#include "obscura/settings.h"

namespace obscura::tools {

struct ImageSize {
  int width = 640, height = 360;
};

// Pixels on the left and right, above and below; or a share of the visible size.
struct GuardBandSpec {
  bool per_cent = true;
  double x = 10, y = 10;

  GuardBand resolve(ImageSize visible) const;
};

// Splits at `separator` into exactly `count` finite numbers.
bool parse_numbers(std::string_view text, char separator, int count, double* numbers);

}  // namespace obscura::tools

namespace obscura {

template <>
struct SettingText<tools::ImageSize> {
  static constexpr const char* form = "WIDTHxHEIGHT in pixels, each in [1, 65535]";
  static bool parse(std::string_view text, tools::ImageSize* value);
  static std::string write(const tools::ImageSize& value);
};
template <>
struct SettingText<tools::GuardBandSpec> {
  static constexpr const char* form = "N, X,Y or N% (pixels, or per cent of the visible size)";
  static bool parse(std::string_view text, tools::GuardBandSpec* value);
  static std::string write(const tools::GuardBandSpec& value);
};
template <>
struct SettingText<std::optional<double>> {
  static constexpr const char* form = "a positive number";
  static bool parse(std::string_view text, std::optional<double>* value);
  static std::string write(const std::optional<double>& value);
};

}  // namespace obscura

#endif  // OBSCURA_IO_IMAGES_VIEW_SIZE_H_
