#ifndef OBSCURA_REPRODUCE_TEMPORAL_H_
#define OBSCURA_REPRODUCE_TEMPORAL_H_

#include "reproduce/reproduce.h"

namespace obscura::tools {

Status reproduce_temporal(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_TEMPORAL_H_
