#ifndef OBSCURA_REPRODUCE_TERRAIN_H_
#define OBSCURA_REPRODUCE_TERRAIN_H_

#include "reproduce/reproduce.h"

namespace obscura::tools {

Status reproduce_terrain_pictures(const ReproduceContext& context, Report* report,
                                  std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_TERRAIN_H_
