#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_BLURRED_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_BLURRED_H_

#include <memory>

#include "screen/method.h"

namespace obscura {

// A method whose visibility passes through the edge-aware blur (filters/bilateral.h). The inner
// method writes finite numbers to background pixels. Surfaces farther apart than `edge` (world
// units) are kept apart; `width` x `height` is the whole depth image.
std::unique_ptr<Method> make_blurred(std::unique_ptr<Method> method, float edge, int width,
                                     int height);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_BLURRED_H_
