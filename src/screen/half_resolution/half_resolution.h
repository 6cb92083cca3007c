#ifndef OBSCURA_SRC_SCREEN_HALF_RESOLUTION_HALF_RESOLUTION_H_
#define OBSCURA_SRC_SCREEN_HALF_RESOLUTION_HALF_RESOLUTION_H_

#include <memory>

#include "screen/method.h"

namespace obscura {

// A method that sees every second pixel of every second row of the visible part, as an image of its
// own by a camera of its own, so that every depth stays where it was measured. `method` is made for
// images of view::half_of(width) x view::half_of(height). The pixels between are filled in from
// their neighbours (filters/upsampling), directions as differences to the normal.
std::unique_ptr<Method> make_half_resolution(std::unique_ptr<Method> method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_HALF_RESOLUTION_HALF_RESOLUTION_H_
