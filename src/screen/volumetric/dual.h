#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_DUAL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_DUAL_H_

#include <memory>

#include "obscura/dual_radius.h"
#include "screen/method.h"

namespace obscura {

// Two methods that give visibility, as one: the product or the minimum of their results (Loos and
// Sloan 2010, section 6). `width` x `height` is the whole depth image.
std::unique_ptr<Method> make_dual(std::unique_ptr<Method> first, std::unique_ptr<Method> second,
                                  Combine combine, int width, int height);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_DUAL_H_
