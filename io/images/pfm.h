#ifndef OBSCURA_IO_IMAGES_PFM_H_
#define OBSCURA_IO_IMAGES_PFM_H_

#include <string>
#include <string_view>

#include "io/images/image.h"
#include "obscura/status.h"

namespace obscura::tools {

// Portable float map: channel Y ("Pf"), or R, G, B ("PF"); rows are stored from the bottom.
// `name` stands in messages.
Status decode_pfm(std::string_view bytes, const std::string& name, Image* image);

// One or three channels.
Status encode_pfm(const Image& image, std::string* bytes);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_PFM_H_
