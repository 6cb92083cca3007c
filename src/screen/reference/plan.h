#ifndef OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_

#include <memory>

#include "obscura/reference.h"
#include "screen/method.h"

namespace obscura {

// The ray-traced reference; settings and contract: obscura/reference.h.
Status make_reference(const ReferenceSettings& settings, std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_
