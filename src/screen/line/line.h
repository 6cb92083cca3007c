#ifndef OBSCURA_SRC_SCREEN_LINE_LINE_H_
#define OBSCURA_SRC_SCREEN_LINE_LINE_H_

#include <memory>

#include "obscura/line.h"
#include "screen/method.h"

namespace obscura {

// Line sampling of volumetric obscurance; settings and paper: obscura/line.h.
// `width` x `height` is the whole depth image.
Status make_line(const LineSettings& settings, int width, int height,
                 std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_LINE_LINE_H_
