#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_

#include <memory>

#include "math/falloff.h"
#include "obscura/far_field.h"
#include "screen/method.h"

namespace obscura {

// Validates settings and puts the preset's in their place.
Status resolve_far_field(const FarFieldSettings& given, FarFieldSettings* resolved, math::Rho* rho);

// Far-field ambient obscurance; settings and paper: obscura/far_field.h.
Status make_far_field(const FarFieldSettings& settings, std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_
