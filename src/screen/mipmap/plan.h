#ifndef OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_

#include <memory>

#include "math/falloff.h"
#include "obscura/mipmap.h"
#include "screen/method.h"

namespace obscura {

Status check_mipmap(const MipmapSettings& settings, math::Rho* rho);

// Ambient obscurance from a depth pyramid; settings and paper: obscura/mipmap.h.
Status make_mipmap(const MipmapSettings& settings, std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_
