#ifndef OBSCURA_SRC_CORE_TEXT_H_
#define OBSCURA_SRC_CORE_TEXT_H_

#include <sstream>
#include <string>

namespace obscura {

// Joins its arguments as text, for messages. (std::format is not in the compilers we support.)
template <class... Args>
std::string text(const Args&... args) {
  std::ostringstream out;
  (out << ... << args);
  return out.str();
}

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_TEXT_H_
