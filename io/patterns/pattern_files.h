#ifndef OBSCURA_IO_PATTERNS_PATTERN_FILES_H_
#define OBSCURA_IO_PATTERNS_PATTERN_FILES_H_

#include <functional>
#include <string>

#include "io/report/json.h"
#include "obscura/patterns.h"

namespace obscura::tools {

// Makes one pattern and describes it: {"rows": [...quality...], "samples": [[x, y(, z), weight for
// rho = 1, weight for (1-r)^2], ...], ...}.
Status describe_pattern(bool ball, const PatternSettings& settings, Json* json);

// The tables that ship, src/screen/volumetric/patterns/*.inc: patterns of 1, 2, ... samples, made
// with the default settings.
enum class PatternTable { kDisks, kCenteredDisks, kBalls };

}  // namespace obscura::tools

template <>
struct obscura::EnumNames<obscura::tools::PatternTable> {
  static constexpr const char* names[] = {"disks", "centered-disks", "balls"};
};

namespace obscura::tools {

// A table made afresh. Takes minutes; `progress` is told the share done.
std::string make_pattern_table(PatternTable table, const std::function<void(double)>& progress);

// Makes a shipped pattern again and tells whether it is within 1e-5 of what ships.
bool pattern_ships_as_made(PatternTable table, int samples);

inline constexpr int kShippedPatterns = 2 * kMaxDiskSamples + kMaxBallSamples;

// Makes `count` of all shipped patterns again, spread evenly over them, on every processor, and
// fails with the names of those that differ from what ships.
Status check_patterns(int count);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PATTERNS_PATTERN_FILES_H_
