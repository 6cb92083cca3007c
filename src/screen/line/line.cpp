#include "screen/line/line.h"

namespace obscura {

Status make_line(const LineSettings&, int, int, std::unique_ptr<Method>*) {
  return unsupported("line sampling is not written yet");
}

}  // namespace obscura
