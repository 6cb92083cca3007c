#ifndef OBSCURA_REPRODUCE_BENT_H_
#define OBSCURA_REPRODUCE_BENT_H_

#include "reproduce/reproduce.h"

// The figures of bent normals and cones (Klehm et al. 2011), measured again.
namespace obscura::tools {

Status reproduce_bent_overhead(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_bent_fig6(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_bent_fig7(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_bent_fig8(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_BENT_H_
