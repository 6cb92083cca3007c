#ifndef OBSCURA_RESOLUTION_H_
#define OBSCURA_RESOLUTION_H_

#include "obscura/export.h"
#include "obscura/settings.h"

namespace obscura {

// At how many pixels a method works. kHalf: at every second one of every second row, with lengths
// in pixels twice as long; the others are filled in between them, along surfaces and not across
// their edges. A quarter of the work. What is one pixel wide, and lies between the pixels that were
// worked at, takes what the surface nearest in depth has.
enum class OBSCURA_EXPERIMENTAL Resolution { kFull, kHalf };
template <>
struct EnumNames<Resolution> {
  static constexpr const char* names[] = {"full", "half"};
};

inline Field resolution_field() {
  return {"resolution", "", {}, "Compute every pixel, or a quarter of them and fill in the rest."};
}

}  // namespace obscura

#endif  // OBSCURA_RESOLUTION_H_
