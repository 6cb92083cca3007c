#ifndef OBSCURA_SCENE_VOLUMES_PROCEDURAL_H_
#define OBSCURA_SCENE_VOLUMES_PROCEDURAL_H_

#include "io/volumes/volume_image.h"

namespace obscura::tools {

bool is_procedural_volume(const std::string& spec);

// volume:NAME?size=N&seed=N: a cube of side 1 in N^3 voxels of f32. The values are like a signed
// distance in units of the side, positive in matter; the surface is at 0. The same specification
// gives the same bits. `threads` as for make_executor.
Status make_procedural_volume(const std::string& spec, VolumeImage* image, int threads = 0);

// "volume:gyroid, volume:sphere, ...", for help.
std::string procedural_volume_names();

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_PROCEDURAL_H_
