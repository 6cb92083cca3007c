#ifndef OBSCURA_IO_SEQUENCES_FRAME_NAMES_H_
#define OBSCURA_IO_SEQUENCES_FRAME_NAMES_H_

#include <string>
#include <vector>

#include "obscura/status.h"

namespace obscura::tools {

// Whether a name has a place for the frame's number: #### (as many digits as there are #), %d or
// %04d as printf, $F or $F4 as Houdini.
bool has_frame_number(const std::string& name);

// The name with every such place filled in. A number with more digits than asked for keeps them.
std::string name_of_frame(const std::string& name, int frame);

// "1-240", "1-240x2" (every second), "1,5,10-20": numbers in the order given, each once. At most a
// million; a number is in [-9999999, 9999999].
Status parse_frames(const std::string& text, std::vector<int>* frames);

// One part of a list that several machines share.
struct Shard {
  int index = 1, count = 1;  // 1 <= index <= count
};
// "I/N", with I from 1.
Status parse_shard(const std::string& text, Shard* shard);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_SEQUENCES_FRAME_NAMES_H_
