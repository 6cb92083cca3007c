#ifndef OBSCURA_SRC_CORE_GUARDED_H_
#define OBSCURA_SRC_CORE_GUARDED_H_

#include <new>

#include "core/text.h"
#include "obscura/status.h"

namespace obscura {

// The body of a public function that allocates: running out of memory is a Status, for nothing is
// thrown across the library's surface. `what` is named in the message.
template <class F>
Status guarded(const char* what, F&& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, text("out of memory in ", what)};
  }
}

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_GUARDED_H_
