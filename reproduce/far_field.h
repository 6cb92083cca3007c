#ifndef OBSCURA_REPRODUCE_FAR_FIELD_H_
#define OBSCURA_REPRODUCE_FAR_FIELD_H_

#include "reproduce/reproduce.h"

// The tables and figures of far-field ambient obscurance (Timonen 2013), measured again.
namespace obscura::tools {

Status reproduce_ffao_table1(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_ffao_table2(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_ffao_table3(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_ffao_table4(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_ffao_fig7(const ReproduceContext& context, Report* report, std::string* text);
// Errors and times of many settings, from which the presets are chosen.
Status reproduce_ffao_front(const ReproduceContext& context, Report* report, std::string* text);
// Regression thresholds of the far field, each figure beside its threshold.
Status reproduce_ffao_bars(const ReproduceContext& context, Report* report, std::string* text);
Status reproduce_error_vs_time(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_FAR_FIELD_H_
