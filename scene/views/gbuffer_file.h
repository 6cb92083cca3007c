#ifndef OBSCURA_SCENE_VIEWS_GBUFFER_FILE_H_
#define OBSCURA_SCENE_VIEWS_GBUFFER_FILE_H_

#include <string>

#include "io/images/depth_input.h"
#include "scene/views/view_spec.h"

namespace obscura::tools {

// Writes a rendered depth field as OpenEXR: Z, N.X N.Y N.Z in eye space, ZBack where there is back
// depth, layerK.Z and layerK.ZBack (K from 1) where there are layers. The data window holds the
// guard band, the display window the visible part; worldToCamera and worldToNDC hold the camera, so
// that the file can be read back without further options. `made_by` is ExrWriteOptions::made_by.
Status write_gbuffer(const std::string& path, const DepthInput& input, const ViewSpec& view,
                     bool half_normals, const std::string& made_by = "");

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VIEWS_GBUFFER_FILE_H_
