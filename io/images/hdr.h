#ifndef OBSCURA_IO_IMAGES_HDR_H_
#define OBSCURA_IO_IMAGES_HDR_H_

#include <string>
#include <string_view>

#include "io/images/image.h"
#include "obscura/status.h"

namespace obscura::tools {

// Radiance RGBE (.hdr), flat or run-length coded, rows from the top: linear R, G, B, divided by the
// EXPOSURE and COLORCORR lines of the header. `name` stands in messages.
Status decode_hdr(std::string_view bytes, const std::string& name, Image* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_HDR_H_
