#ifndef OBSCURA_REPRODUCE_VOLUMETRIC_H_
#define OBSCURA_REPRODUCE_VOLUMETRIC_H_

#include "reproduce/reproduce.h"

namespace obscura::tools {

// Volumetric obscurance (Loos and Sloan 2010).

// Table 1: times and errors of lines and points, single and double radius.
Status reproduce_vo_table1(const ReproduceContext& context, Report* report, std::string* text);

// Loos and Sloan 2010, section 5: do lines flicker less than points at equal cost?
Status reproduce_vo_flicker(const ReproduceContext& context, Report* report, std::string* text);

// Loos and Sloan 2010, section 4.5 and Figure 4: integration error of the sample patterns and of
// well-known sets.
Status reproduce_vo_patterns(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_VOLUMETRIC_H_
