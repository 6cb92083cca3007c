#ifndef OBSCURA_IO_RASTERS_NPY_H_
#define OBSCURA_IO_RASTERS_NPY_H_

#include <string>
#include <string_view>

#include "io/images/image.h"
#include "obscura/status.h"

namespace obscura::tools {

// A two-dimensional NumPy array of integers or floats, in either byte order and either order of its
// axes, as channel Y. `name` stands in messages.
Status decode_npy(std::string_view bytes, const std::string& name, Image* image);

// float32: (height, width), or (channels, height, width) where there are several.
void encode_npy(const Image& image, std::string* bytes);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_RASTERS_NPY_H_
