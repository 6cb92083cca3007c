#ifndef OBSCURA_IO_PATTERNS_PATTERN_FILES_H_
#define OBSCURA_IO_PATTERNS_PATTERN_FILES_H_

#include <functional>
#include <string>

#include "nlohmann/json.hpp"
#include "obscura/patterns.h"

namespace obscura::tools {

// Makes one pattern and describes it: {"rows": [...quality...], "samples": [[x, y(, z), weight for
// rho = 1, weight for (1-r)^2], ...], ...}.
Status describe_pattern(bool ball, const PatternSettings& settings, nlohmann::ordered_json* json);

// The source of src/screen/volumetric/patterns/pattern_tables.cpp: every pattern that ships, made
// afresh with the default settings. Takes minutes; `progress` is told the share done.
std::string pattern_tables_source(const std::function<void(double)>& progress = {});

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PATTERNS_PATTERN_FILES_H_
