#ifndef OBSCURA_SRC_CORE_CHECK_SPHERE_H_
#define OBSCURA_SRC_CORE_CHECK_SPHERE_H_

#include <string_view>

#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

// What methods that integrate over a sphere have in common: its radius is finite, rho constant or
// quadratic, occluders solid or of one thickness. `method` is its name for messages.
Status check_sphere(const Falloff& falloff, const Occluder& occluder, std::string_view method);
// The falloff alone.
Status check_sphere(const Falloff& falloff, std::string_view method);

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_CHECK_SPHERE_H_
