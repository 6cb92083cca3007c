#include "io/images/view_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace tools {

GuardBand GuardBandSpec::resolve(ImageSize visible) const {
  auto pixels = [&](double n, int side) {
    const double count = per_cent ? std::round(n / 100 * side) : n;
    return int(std::min(count, 1e6));
  };
  return GuardBand::symmetric(pixels(x, visible.width), pixels(y, visible.height));
}

bool parse_numbers(std::string_view text, char separator, int count, double* numbers) {
  for (int i = 0; i < count; ++i) {
    const std::size_t end = text.find(separator);
    if ((end == std::string_view::npos) != (i + 1 == count)) return false;
    if (!parse_number(text.substr(0, end), &numbers[i]) || !std::isfinite(numbers[i])) return false;
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
  return true;
}

}  // namespace tools

namespace {

using tools::parse_numbers;

bool whole(double v, double min) { return v >= min && v <= 65535 && v == std::floor(v); }

}  // namespace

bool SettingText<tools::ImageSize>::parse(std::string_view text, tools::ImageSize* value) {
  double n[2];
  if (!parse_numbers(text, 'x', 2, n) || !whole(n[0], 1) || !whole(n[1], 1)) return false;
  *value = {int(n[0]), int(n[1])};
  return true;
}

std::string SettingText<tools::ImageSize>::write(const tools::ImageSize& value) {
  return fmt::format("{}x{}", value.width, value.height);
}

bool SettingText<tools::GuardBandSpec>::parse(std::string_view text, tools::GuardBandSpec* value) {
  double n[2];
  if (!text.empty() && text.back() == '%') {
    if (!parse_numbers(text.substr(0, text.size() - 1), ',', 1, n)) return false;
    if (!(n[0] >= 0 && n[0] <= 1000)) return false;
    *value = {true, n[0], n[0]};
    return true;
  }
  if (parse_numbers(text, ',', 1, n)) {
    n[1] = n[0];
  } else if (!parse_numbers(text, ',', 2, n)) {
    return false;
  }
  if (!whole(n[0], 0) || !whole(n[1], 0)) return false;
  *value = {false, n[0], n[1]};
  return true;
}

std::string SettingText<tools::GuardBandSpec>::write(const tools::GuardBandSpec& value) {
  return value.per_cent ? fmt::format("{:g}%", value.x)
                        : fmt::format("{:g},{:g}", value.x, value.y);
}

bool SettingText<std::optional<double>>::parse(std::string_view text,
                                               std::optional<double>* value) {
  double n;
  if (!parse_numbers(text, ' ', 1, &n) || !(n > 0)) return false;
  *value = n;
  return true;
}

std::string SettingText<std::optional<double>>::write(const std::optional<double>& value) {
  return value ? fmt::format("{:g}", *value) : "";
}

}  // namespace obscura
