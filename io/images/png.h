#ifndef OBSCURA_IO_IMAGES_PNG_H_
#define OBSCURA_IO_IMAGES_PNG_H_

#include <string>
#include <string_view>

#include "io/images/image.h"
#include "obscura/status.h"

namespace obscura::tools {

// 8 or 16 bits per channel, as values in [0, 1]: channel Y, or R, G, B (alpha is left out).
// `sixteen_bits` says which, when it is asked for. `name` stands in messages. Check sums are
// verified: a damaged file is refused.
Status decode_png(std::string_view bytes, const std::string& name, Image* image,
                  bool* sixteen_bits = nullptr);

// One or three channels to `bits` (8 or 16) per channel: [0, 1] to 0..255 or 0..65535, rounded;
// what lies outside is clamped and NaN becomes 0.
Status encode_png(const Image& image, int bits, std::string* bytes);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_PNG_H_
