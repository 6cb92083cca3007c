#ifndef OBSCURA_SUPPORT_FILES_PNG_H_
#define OBSCURA_SUPPORT_FILES_PNG_H_

#include <string>
#include <string_view>

#include "obscura/status.h"
#include "support/image.h"

namespace obscura::support {

// 8 or 16 bits per channel, as values in [0, 1]: channel Y, or R, G, B (alpha is left out).
// `sixteen_bits` says which, when it is asked for. `name` stands in messages.
Status decode_png(std::string_view bytes, const std::string& name, Image* image,
                  bool* sixteen_bits = nullptr);

// Radiance RGBE (.hdr): linear R, G, B.
Status decode_hdr(std::string_view bytes, const std::string& name, Image* image);

// One or three channels to 8 bits: [0, 1] to 0..255, rounded; what lies outside is clamped and NaN
// becomes 0.
Status encode_png(const Image& image, std::string* bytes);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_FILES_PNG_H_
