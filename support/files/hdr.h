#ifndef OBSCURA_SUPPORT_FILES_HDR_H_
#define OBSCURA_SUPPORT_FILES_HDR_H_

#include <string>
#include <string_view>

#include "obscura/status.h"
#include "support/image.h"

namespace obscura::support {

// Radiance RGBE (.hdr), flat or run-length coded, rows from the top: linear R, G, B. The header's
// EXPOSURE is left to the user, as in other readers. `name` stands in messages.
Status decode_hdr(std::string_view bytes, const std::string& name, Image* image);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_FILES_HDR_H_
