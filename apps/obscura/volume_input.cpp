#include "apps/obscura/volume_input.h"

#include <cmath>

#include "fmt/format.h"
#include "obscura/settings.h"

namespace obscura::app {
namespace {

// Three positive numbers with `between` between them.
bool parse_three(const std::string& text, char between, bool whole, double* values) {
  std::size_t at = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t end = text.find(between, at);
    const bool last = end == std::string::npos;
    if (last != (k == 2) ||
        !parse_number(text.substr(at, last ? std::string::npos : end - at), &values[k]) ||
        !(values[k] > 0 && values[k] < 1e9) || (whole && values[k] != std::floor(values[k]))) {
      return false;
    }
    at = end + 1;
  }
  return true;
}

}  // namespace

void VolumeInputOptions::add_to(CLI::App* command) {
  const char* group = "Volume files";
  command->add_option("--raw-size", size_, "Voxels of a .raw file along x (fastest), y and z")
      ->type_name("NXxNYxNZ")
      ->group(group);
  command->add_option("--raw-type", type_, "Its samples: u8, i16, u16 or f32 [default u8]")
      ->type_name("TYPE")
      ->group(group);
  command->add_option("--raw-spacing", spacing_, "World units between its voxels [default 1,1,1]")
      ->type_name("X,Y,Z")
      ->group(group);
  command->add_flag("--raw-big-endian", big_endian_, "Its samples have their high byte first")
      ->group(group);
  command
      ->add_option("--grid", choice_.grid,
                   "Grid of an OpenVDB file [density, else the first with two values]")
      ->type_name("NAME")
      ->group(group);
  command
      ->add_option("--volume-index", choice_.index,
                   "Volume of a NIfTI file with several, counted from 0 [default 0]")
      ->check(CLI::Range(0, 1000000000))
      ->type_name("N")
      ->group(group);
  command
      ->add_option("--clip", clip_,
                   "Keep these voxels only, counted from 0, both ends included; an end left out is "
                   "the volume's")
      ->type_name("X0:X1,Y0:Y1,Z0:Z1")
      ->group(group);
}

Status VolumeInputOptions::read_layout(std::optional<tools::RawLayout>* layout) const {
  std::optional<tools::RawLayout>& raw = *layout;
  if (!size_.empty()) {
    raw.emplace();
    double size[3];
    if (!parse_three(size_, 'x', true, size)) {
      return invalid_argument(
          fmt::format("--raw-size is '{}'; it must be NXxNYxNZ, such as 256x256x128", size_));
    }
    for (int a = 0; a < 3; ++a) raw->size[a] = int(size[a]);
    if (!type_.empty()) {
      if (Status s = parse_setting("--raw-type", Field{}, type_, &raw->type); !s.ok()) return s;
    }
    if (!spacing_.empty() && !parse_three(spacing_, ',', false, raw->spacing.data())) {
      return invalid_argument(fmt::format(
          "--raw-spacing is '{}'; it must be three numbers in [1e-12, 1e12]", spacing_));
    }
    raw->big_endian = big_endian_;
  } else if (!type_.empty() || !spacing_.empty() || big_endian_) {
    return invalid_argument("--raw-type, --raw-spacing and --raw-big-endian need --raw-size");
  }
  return {};
}

std::string VolumeInputOptions::text() const {
  return fmt::format("raw={},{},{},{}", size_, type_, spacing_, big_endian_);
}

Status VolumeInputOptions::open(const std::string& path, tools::PlaneFile* file) const {
  std::optional<tools::RawLayout> raw;
  if (Status s = read_layout(&raw); !s.ok()) return s;
  if (!clip_.empty()) {
    return unsupported("--clip needs the whole volume in memory; cut the file itself");
  }
  if (!choice_.grid.empty() || choice_.index) {
    return unsupported("--grid and --volume-index are for files that are read whole");
  }
  return file->open(path, raw);
}

Status VolumeInputOptions::load(const std::string& path, int threads,
                                tools::VolumeImage* image) const {
  std::optional<tools::RawLayout> raw;
  if (Status s = read_layout(&raw); !s.ok()) return s;
  tools::ClipBox box;
  if (!clip_.empty()) {
    if (Status s = tools::parse_clip(clip_, &box); !s.ok()) return s;
  }
  if (Status s = tools::load_volume(path, raw, image, threads, choice_); !s.ok()) return s;
  for (const std::string& note : image->notes) fmt::print(stderr, "obscura: note: {}\n", note);
  return clip_.empty() ? Status() : tools::clip(box, image);
}

}  // namespace obscura::app
