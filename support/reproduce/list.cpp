#include "support/reproduce/reproduce.h"

namespace obscura::support {

const std::vector<Reproduction>& reproductions() {
  static const std::vector<Reproduction> list = {};
  return list;
}

}  // namespace obscura::support
