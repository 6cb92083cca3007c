#ifndef OBSCURA_APPS_OBSCURA_VOLUME_COMMAND_H_
#define OBSCURA_APPS_OBSCURA_VOLUME_COMMAND_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/obscura/option_table.h"
#include "apps/obscura/sequence.h"
#include "apps/obscura/volume_input.h"
#include "io/images/files.h"
#include "io/images/image.h"
#include "scene/volumes/field_blocks.h"
#include "scene/volumes/volume_light.h"
#include "scene/volumes/volume_picture.h"
#include "scene/volumes/volume_view.h"

// Parts of the command `obscura volume`: its options, and what it writes.
namespace obscura::app {

enum class VolumeMethod { kSweep, kMonteCarlo };
using tools::FieldsKind;

struct PictureSettings {
  VolumeMethod method = VolumeMethod::kSweep;
  FieldsKind fields_of = FieldsKind::kOctants;
  tools::PictureColours colours{};
  tools::OuterSurface outer{};
  std::optional<double> gamma{};  // 2 for a lit picture, 1 for bare visibility
};

// The library's settings as this command names them.
struct VolumeSettings {
  tools::VolumeViewOptions view{};
  SurfaceSettings surface{};
  DistanceSettings distance{};
  OcclusionSettings occlusion{};
  MonteCarloSettings monte_carlo{};
  PictureSettings picture{};
};

}  // namespace obscura::app

namespace obscura {
template <>
struct EnumNames<app::VolumeMethod> {
  static constexpr const char* names[] = {"sweep", "monte-carlo"};
};

namespace app {

template <FieldsOf<VolumeSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  auto renamed = [&](const char* from, const char* to) {
    return [&v, from, to](auto& value, Field field) {
      if (std::string_view(field.name) == from) field.name = to;
      // Opacity comes with the light.
      if (std::string_view(field.name) != "alpha") v(value, field);
    };
  };
  visit_fields(s.view, v);
  visit_fields(s.surface, v);
  visit_fields(s.picture.colours, v);
  visit_fields(s.picture.outer, v);
  v(s.picture.gamma,
    Field{"gamma", "", {}, "Of a .png: light to the power 1/gamma; 2 for a lit picture, else 1."});
  visit_fields(s.distance, [&](auto& value, Field field) {
    if (std::string_view(field.name) == "isovalue") field.name = "iso";
    renamed("start", "distance_start")(value, field);
  });
  visit_fields(s.occlusion, renamed("", ""));
  v(s.picture.method, Field{"method", "", {}, "Sweeps, or rays through the same distance field."});
  visit_fields(s.monte_carlo, renamed("start", "ray_start"));
  v(s.picture.fields_of, Field{"fields_of", "", {}, "What --fields writes."});
}

struct VolumeCommand {
  std::string input, output, outputs, light, fields, json, memory;
  VolumeInputOptions volume;
  SequenceOptions sequence;
  OptionTable table;
  int threads = 0;
  bool half = false;
};

// What the options say.
struct VolumeRequest {
  VolumeSettings settings;
  tools::VolumeLight light;
  std::string light_name;
  bool visibility = false, coverage = false, depth = false;
  // Whether the output is a picture in colours: a .png of the light `lit`.
  bool picture = false;
  double gamma = 1;
};

// Everything that can be wrong before a voxel is read.
Status read_request(const VolumeCommand& command, VolumeRequest* request);

struct VolumePictures {
  tools::Image visibility, coverage, depth;  // a channel each
  tools::Image facing;                       // of an outer surface: the light of a camera's lamp

  void allocate(int width, int height);
};

// Mean over the pixels that the surface covers, background taken out of those it covers partly.
double mean_visibility(const VolumePictures& pictures);
Status write_volume_picture(const std::string& path, const tools::WriteOptions& write,
                            const VolumeRequest& request, VolumePictures pictures,
                            const VolumePictures* outer);
Status write_volume_fields(const std::string& path, FieldsKind kind,
                           const tools::VolumeImage& image, const std::vector<float>& distance,
                           const VisibilityField& field, const RunOptions& run);

// A picture of an isosurface, its fields, or both. All but the files last as long as the frame.
std::unique_ptr<CommandFrame> make_volume_frame(const VolumeCommand& command,
                                                const VolumeRequest& request, Executor* executor,
                                                bool quiet, FrameFiles files);

}  // namespace app
}  // namespace obscura

#endif  // OBSCURA_APPS_OBSCURA_VOLUME_COMMAND_H_
