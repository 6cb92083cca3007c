#include "obscura/settings.h"

#include <charconv>

#include "core/text.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

std::string to_string(const Range& range) {
  auto bound = [](double v) {
    if (std::isinf(v)) return std::string(v < 0 ? "-inf" : "inf");
    // Whole numbers to the last digit: 4294967295, not 4.29497e+09.
    const bool whole = v == std::floor(v) && std::abs(v) < 1e15;
    return whole ? std::to_string(static_cast<std::int64_t>(v)) : text(v);
  };
  const bool open_below = range.min_excluded || std::isinf(range.min);
  const bool open_above = range.max_excluded;
  return text(open_below ? "(" : "[", bound(range.min), ", ", bound(range.max),
              open_above ? ")" : "]");
}

bool parse_number(std::string_view text, double* value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return error == std::errc() && end == text.data() + text.size() && !std::isnan(*value);
}

std::string write_number(double value, bool single_precision) {
  char buffer[32];
  // The shortest digits that read back as the same number.
  const auto result =
      single_precision ? std::to_chars(buffer, buffer + sizeof(buffer), static_cast<float>(value))
                       : std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, result.ptr);
}

Status bad_setting(std::string_view name, std::string_view given, std::string_view expected) {
  return invalid_argument(text(name, " is '", given, "'; it must be ", expected));
}

std::string one_of(std::span<const char* const> names) {
  std::string list = "one of ";
  for (std::size_t i = 0; i < names.size(); ++i) list += text(i ? ", " : "", names[i]);
  return list;
}

bool SettingText<Occluder>::parse(std::string_view given, Occluder* value) {
  for (const Occluder& plain : {Occluder::solid(), Occluder::back_depth(), Occluder::automatic()}) {
    if (given != enum_name(plain.kind)) continue;
    *value = plain;
    return true;
  }
  const auto colon = given.find(':');
  double number;
  if (colon == std::string_view::npos || !parse_number(given.substr(colon + 1), &number)) {
    return false;
  }
  Occluder parsed;
  if (given.starts_with("thickness:")) {
    parsed = Occluder::of_thickness(static_cast<float>(number));
  } else if (given.starts_with("layers:") && Occluder::kLayersRange.contains(number) &&
             number == std::floor(number)) {
    parsed = Occluder::of_layers(static_cast<int>(number));
  } else {
    return false;
  }
  if (!validate(parsed).ok()) return false;
  *value = parsed;
  return true;
}

std::string SettingText<Occluder>::form() {
  return text("auto, solid, thickness:T with T in ", to_string(Occluder::kThicknessRange),
              ", back-depth or layers:K with K in ", to_string(Occluder::kLayersRange));
}

std::string SettingText<Occluder>::write(const Occluder& value) {
  switch (value.kind) {
    case OccluderKind::kThickness:
      return "thickness:" + write_number(value.thickness, true);
    case OccluderKind::kLayers:
      return text("layers:", value.layers);
    case OccluderKind::kSolid:
    case OccluderKind::kBackDepth:
    case OccluderKind::kAuto:
      break;
  }
  return enum_name(value.kind);
}

Status out_of_range(const Field& field, double value) {
  return invalid_argument(
      text(field.name, " is ", value, "; it must be in ", to_string(field.range)));
}

Status validate(const Falloff& falloff) {
  if (falloff.kind == FalloffKind::kFunction) {
    if (!falloff.function) return invalid_argument("falloff.function is empty; give a callable");
    return {};
  }
  if (Status s = validate_ranges(falloff); !s.ok()) return s;
  if (falloff.kind == FalloffKind::kTable) {
    if (falloff.table.size() < 2) {
      return invalid_argument(
          text("falloff.table has ", falloff.table.size(), " values; it needs at least 2"));
    }
    for (float v : falloff.table) {
      if (!(v >= 0 && v <= 1)) {
        return invalid_argument(text("falloff.table holds ", v, "; values must be in [0, 1]"));
      }
    }
    if (std::isinf(falloff.radius)) {
      return invalid_argument("radius is inf; a falloff table needs a finite one");
    }
  }
  return {};
}

Status validate(const Occluder& occluder) {
  if (occluder.kind == OccluderKind::kThickness &&
      !Occluder::kThicknessRange.contains(occluder.thickness)) {
    return out_of_range({"occluder thickness", "", Occluder::kThicknessRange, ""},
                        occluder.thickness);
  }
  if (occluder.kind == OccluderKind::kLayers && !Occluder::kLayersRange.contains(occluder.layers)) {
    return out_of_range({"occluder layers", "", Occluder::kLayersRange, ""}, occluder.layers);
  }
  return {};
}

}  // namespace obscura
