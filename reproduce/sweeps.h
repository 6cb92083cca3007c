#ifndef OBSCURA_REPRODUCE_SWEEPS_H_
#define OBSCURA_REPRODUCE_SWEEPS_H_

#include "reproduce/reproduce.h"

// Fast occlusion sweeping (Singh, Yuksel and House 2011).
namespace obscura::tools {

Status reproduce_sweep_table2(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_sweep_error(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_sweep_fig3(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_sweep_figures(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_SWEEPS_H_
