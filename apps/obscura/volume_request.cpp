// The options of obscura volume: what they may be together.
#include "apps/obscura/volume_command.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/volumes/vdb.h"

namespace obscura::app {
namespace {

Status parse_outputs(const VolumeCommand& c, VolumeRequest* p) {
  const std::string list = (c.outputs.empty() ? "visibility" : c.outputs) + ",";
  for (std::size_t at = 0, comma; (comma = list.find(',', at)) != std::string::npos;
       at = comma + 1) {
    const std::string name = list.substr(at, comma - at);
    bool* wanted = name == "visibility" ? &p->visibility
                   : name == "coverage" ? &p->coverage
                   : name == "depth"    ? &p->depth
                                        : nullptr;
    if (!wanted) {
      return invalid_argument(fmt::format(
          "--outputs names '{}'; it must be a list of visibility, coverage, depth", name));
    }
    *wanted = true;
  }
  const std::string ending = tools::file_ending(c.output);
  if (int(p->visibility) + int(p->coverage) + int(p->depth) > 1 && ending != ".exr") {
    return invalid_argument(fmt::format(
        "--output {} can hold one result; name one in --outputs, or write .exr", c.output));
  }
  if (p->depth && ending == ".png") {
    return invalid_argument(fmt::format(
        "--output {} cannot hold depth, which is not in [0, 1]; write .exr or .pfm", c.output));
  }
  return {};
}

// The light, as given or as suits the output, and what is for a lit picture only.
Status choose_light(const VolumeCommand& c, VolumeRequest* p) {
  const bool png = tools::file_ending(c.output) == ".png";
  const std::string light = !c.light.empty() ? c.light : png && c.outputs.empty() ? "lit" : "ao";
  if (Status s = tools::parse_volume_light(light, &p->light); !s.ok()) {
    return {s.code(), "--" + s.message()};
  }
  p->picture = p->light.kind == tools::VolumeLight::kLit;
  if (p->picture && (!png || !c.outputs.empty())) {
    return invalid_argument(
        "--light lit makes a picture in colours; write .png without --outputs, or use --light ao");
  }
  for (const char* option :
       {"surface_colour", "background_colour", "outer_iso", "outer_opacity", "outer_colour"}) {
    if (!p->picture && c.table.given(option)) {
      return invalid_argument(
          fmt::format("--{} is for a .png with --light lit", option_name(option)));
    }
  }
  for (const char* option : {"outer_opacity", "outer_colour"}) {
    if (!p->settings.picture.outer.isovalue && c.table.given(option)) {
      return invalid_argument(fmt::format("--{} needs --outer-iso", option_name(option)));
    }
  }
  p->light_name = light;
  const std::optional<double>& gamma = p->settings.picture.gamma;
  if (gamma && !png) {
    return invalid_argument("--gamma is for .png; other files hold linear visibility");
  }
  p->gamma = gamma.value_or(p->picture ? 2 : 1);
  if (!(p->gamma >= 0.1 && p->gamma <= 10)) {
    return invalid_argument(fmt::format("--gamma is {:g}; it must be in [0.1, 10]", p->gamma));
  }
  return {};
}

}  // namespace

Status read_request(const VolumeCommand& c, VolumeRequest* p) {
  if (Status s = c.table.read(&p->settings); !s.ok()) return s;
  if (c.output.empty() && c.fields.empty()) {
    return invalid_argument("nothing to write; give --output, --fields or both");
  }
  const VolumeSettings& settings = p->settings;
  if (!c.output.empty()) {
    if (Status s = tools::check_image_ending(c.output); !s.ok()) return s;
    if (Status s = parse_outputs(c, p); !s.ok()) return s;
  }
  if (Status s = choose_light(c, p); !s.ok()) return s;
  const bool rays = settings.picture.method == VolumeMethod::kMonteCarlo;
  for (const char* option : {"rays", "ray_start", "seed"}) {
    if (!rays && c.table.given(option)) {
      return invalid_argument(
          fmt::format("--{} belongs to --method monte-carlo", option_name(option)));
    }
  }
  if (!c.fields.empty()) {
    const std::string ending = tools::file_ending(c.fields);
    if (ending != ".nrrd" && ending != ".vdb") {
      return invalid_argument(
          fmt::format("--fields is '{}'; it must end in .nrrd or .vdb", c.fields));
    }
    if (ending == ".vdb" && !tools::has_openvdb()) {
      return unsupported("--fields: this build has no OpenVDB; write .nrrd");
    }
    const bool swept = !rays && p->light.kind != tools::VolumeLight::kHeadlight;
    if (settings.picture.fields_of != FieldsKind::kDistance &&
        (!swept || p->light.kind == tools::VolumeLight::kShadow)) {
      return invalid_argument(
          "--fields needs swept octants; leave --method and use --light ao, octants or "
          "translucent, or give --fields-of distance");
    }
  }
  return {};
}

}  // namespace obscura::app
