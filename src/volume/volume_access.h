#ifndef OBSCURA_SRC_VOLUME_VOLUME_ACCESS_H_
#define OBSCURA_SRC_VOLUME_VOLUME_ACCESS_H_

#include "obscura/volume.h"

namespace obscura {

// Strides in samples, with the dense ones filled in.
std::array<std::ptrdiff_t, 3> strides_of(const VolumeView& volume);

// Checks the sizes, spacing and pointer that the caller gave; messages use the given name.
Status validate(const VolumeView& volume);
Status validate_grid(const char* name, const void* data, const std::array<int, 3>& size,
                     const std::array<float, 3>& spacing);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_VOLUME_ACCESS_H_
