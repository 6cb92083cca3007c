#include "io/environments/environment_file.h"

#include <algorithm>

#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::tools {
namespace {

std::string with_dashes(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

// "key=value,key=value" over the sky's fields.
Status parse_sky(std::string_view text, SkySettings* sky) {
  while (!text.empty()) {
    const auto comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    text = comma == std::string_view::npos ? "" : text.substr(comma + 1);
    const auto equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    bool known = false;
    std::string keys;
    Status status;
    visit_fields(*sky, [&](auto& value, const Field& field) {
      const std::string name = with_dashes(field.name);
      keys += (keys.empty() ? "" : ", ") + name;
      if (name != key || equals == std::string_view::npos) return;
      known = true;
      status = parse_setting("sky's " + name, field, part.substr(equals + 1), &value);
    });
    if (!status.ok()) return status;
    if (!known) {
      return invalid_argument(
          fmt::format("sky has no setting '{}'; it takes key=value with {}", part, keys));
    }
  }
  return {};
}

}  // namespace

Status open_environment(const std::string& name, EnvironmentSource* source) {
  EnvironmentSource result;
  result.name = name;
  if (name == "sky" || name.starts_with("sky:")) {
    result.is_sky = true;
    if (Status s = parse_sky(std::string_view(name).substr(std::min<std::size_t>(4, name.size())),
                             &result.sky);
        !s.ok()) {
      return s;
    }
    visit_fields(result.sky, [&](const auto& value, const Field& field) {
      result.content += fmt::format("{}={},", field.name, write_setting(value));
    });
  } else {
    const std::string ending = file_ending(name);
    if (ending != ".hdr" && ending != ".exr" && ending != ".pfm") {
      return invalid_argument(fmt::format(
          "--environment is '{}'; it must be a .hdr, .exr or .pfm file or sky[:settings]", name));
    }
    if (Status s = read_bytes(name, &result.content); !s.ok()) return s;
  }
  *source = std::move(result);
  return {};
}

Status load_environment(const EnvironmentSource& source, Environment* environment,
                        EnvironmentRepairs* repairs, const RunOptions& options) {
  if (source.is_sky) {
    *repairs = {};
    return Environment::from_sky(source.sky, environment, options);
  }
  Image image;
  if (Status s = read_image(source.name, &image); !s.ok()) return s;
  ImageView<const float> rgb[3];
  for (std::size_t k = 0; k < image.channels.size(); ++k) {
    const std::string& channel = image.channels[k].name;
    const ImageView<const float> view = std::as_const(image).view(static_cast<int>(k));
    if (channel == "R") rgb[0] = view;
    if (channel == "G") rgb[1] = view;
    if (channel == "B") rgb[2] = view;
    if (channel == "Y" && image.channels.size() == 1) rgb[0] = rgb[1] = rgb[2] = view;
  }
  const Status s =
      Environment::from_lat_long({rgb[0], rgb[1], rgb[2]}, environment, repairs, options);
  return s.ok() ? s : Status(s.code(), fmt::format("{}: {}", source.name, s.message()));
}

std::string describe(const EnvironmentRepairs& r) {
  std::string parts;
  auto add = [&](std::int64_t count, const char* what) {
    if (count > 0) parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, what);
  };
  add(r.negative, "negative pixels taken as 0");
  add(r.not_a_number, "NaN pixels taken as 0");
  add(r.infinite, "infinite pixels taken as the largest finite value");
  add(r.too_large, "pixels over 1e30 taken as that");
  return parts;
}

std::string sky_help() {
  std::string help = "sky[:key=value,...] with ";
  const SkySettings defaults;
  visit_fields(defaults, [&](const auto& value, const Field& field) {
    help += fmt::format("{}{} (default {})", help.ends_with(' ') ? "" : ", ",
                        with_dashes(field.name), write_setting(value));
  });
  return help;
}

}  // namespace obscura::tools
