#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_H_

#include <memory>

#include "obscura/far_field.h"
#include "screen/method.h"

namespace obscura {

// Far-field ambient obscurance; settings and paper: obscura/far_field.h.
Status make_far_field(const FarFieldSettings& settings, std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_H_
