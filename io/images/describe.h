#ifndef OBSCURA_IO_IMAGES_DESCRIBE_H_
#define OBSCURA_IO_IMAGES_DESCRIBE_H_

#include <string>

#include "io/report/json.h"
#include "obscura/status.h"

namespace obscura::tools {

// What an image file holds: kind, size, windows, channels with type, range and count of values that
// are not finite, EXR attributes, and what of it would be used as depth, normals and camera.
Status describe_image(const std::string& path, Json* description);

// The same as lines of text.
std::string description_text(const Json& description);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_DESCRIBE_H_
