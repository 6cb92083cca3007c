#ifndef OBSCURA_SCENE_VOLUMES_LOAD_VOLUME_H_
#define OBSCURA_SCENE_VOLUMES_LOAD_VOLUME_H_

#include <optional>

#include "io/report/json.h"
#include "io/volumes/planes.h"
#include "io/volumes/volume_image.h"

namespace obscura::tools {

// Which of several volumes in a file.
struct VolumeChoice {
  std::string grid{};          // of a .vdb file
  std::optional<int> index{};  // of a NIfTI file, from 0
};

// Whether load_volume would take the name: a procedural volume's, or an ending of a volume file.
bool is_volume(const std::string& spec);

// Loads volume:NAME?key=value&..., .nii, .nii.gz, .nrrd, .nhdr, .vdb or .raw; `threads` as for
// make_executor.
// What was chosen stands in image->notes.
Status load_volume(const std::string& spec, const std::optional<RawLayout>& raw, VolumeImage* image,
                   int threads = 0, const VolumeChoice& choice = {});

// What the volume holds: format, size, type, spacing, place in the world, range, counts of values
// that are not finite, histogram and Otsu's threshold.
Status describe_volume(const VolumeImage& image, Json* description);
Status describe_volume(const std::string& spec, const std::optional<RawLayout>& raw,
                       Json* description);

// The same as lines of text, with the histogram drawn.
std::string volume_description_text(const Json& description);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_LOAD_VOLUME_H_
