#include "io/patterns/pattern_files.h"

#include <algorithm>
#include <cmath>

#include "fmt/ranges.h"
#include "io/patterns/quality.h"
#include "io/report/report.h"
#include "obscura/executor.h"

namespace obscura::tools {
namespace {

void add_quality(const std::string& name, const PatternQuality& q, Report* report) {
  report->add(name, "half-spaces, rms", q.half_spaces, "% of the sphere");
  report->add(name, "steps, rms", q.steps, "% of the sphere");
  report->add(name, "both, rms", q.both(), "% of the sphere");
}

std::vector<float> numbers(const DiskSample& s) {
  return {s.x, s.y, s.weight_constant, s.weight_quadratic};
}
std::vector<float> numbers(const BallSample& s) {
  return {s.x, s.y, s.z, s.weight_constant, s.weight_quadratic};
}

template <class Sample>
std::vector<std::vector<float>> rows(std::span<const Sample> samples) {
  std::vector<std::vector<float>> rows;
  for (const Sample& s : samples) rows.push_back(numbers(s));
  return rows;
}

std::vector<std::vector<float>> make(PatternTable table, int count) {
  PatternSettings settings;
  settings.count = count;
  settings.center = table == PatternTable::kCenteredDisks;
  if (table == PatternTable::kBalls) {
    std::vector<BallSample> pattern;
    (void)make_ball_pattern(settings, &pattern);  // the settings are valid
    return rows(std::span<const BallSample>(pattern));
  }
  std::vector<DiskSample> pattern;
  (void)make_disk_pattern(settings, &pattern);
  return rows(std::span<const DiskSample>(pattern));
}

std::vector<std::vector<float>> shipped(PatternTable table, int count) {
  if (table == PatternTable::kBalls) return rows(ball_pattern(count));
  return rows(disk_pattern(count, table == PatternTable::kCenteredDisks));
}

bool close(const std::vector<std::vector<float>>& a, const std::vector<std::vector<float>>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      if (!(std::abs(a[i][k] - b[i][k]) <= 1e-5f)) return false;
    }
  }
  return a.size() == b.size();
}

}  // namespace

Status describe_pattern(bool ball, const PatternSettings& settings, Json* json) {
  Report report;
  Json samples = Json::array();
  const std::string name = fmt::format("{} {}{}", ball ? "ball" : "disk", settings.count,
                                       settings.center && !ball ? ", center" : "");
  if (ball) {
    std::vector<BallSample> pattern;
    if (Status s = make_ball_pattern(settings, &pattern); !s.ok()) return s;
    add_quality(name, quality(std::span<const BallSample>(pattern)), &report);
    for (const BallSample& s : pattern) {
      samples.push_back(numbers(s));
    }
  } else {
    std::vector<DiskSample> pattern;
    if (Status s = make_disk_pattern(settings, &pattern); !s.ok()) return s;
    add_quality(name, quality(std::span<const DiskSample>(pattern)), &report);
    for (const DiskSample& s : pattern) {
      samples.push_back(numbers(s));
    }
  }
  visit_fields(settings,
               [&](const auto& value, const Field& field) { report.settings[field.name] = value; });
  report.settings["kind"] = ball ? "ball" : "disk";
  *json = report.json();
  (*json)["samples"] = std::move(samples);
  return {};
}

std::string make_pattern_table(PatternTable table, const std::function<void(double)>& progress) {
  std::string source = fmt::format(
      "// Made by `obscura patterns --table {}`; not edited by hand.\n", enum_name(table));
  const int most = table == PatternTable::kBalls ? kMaxBallSamples : kMaxDiskSamples;
  for (int count = 1; count <= most; ++count) {
    for (const std::vector<float>& row : make(table, count)) {
      source += fmt::format("{{{:.8e}f}},\n", fmt::join(row, "f, "));
    }
    if (progress) progress(double(count) / most);
  }
  return source;
}

bool pattern_ships_as_made(PatternTable table, int samples) {
  return close(make(table, samples), shipped(table, samples));
}

Status check_patterns(int count) {
  struct Check {
    PatternTable table;
    int samples;
    bool good;
  };
  std::vector<Check> checks;
  for (int i = 0; i < count; ++i) {
    const int at = (2 * i + 1) * kShippedPatterns / (2 * count);
    const int table = std::min(at / kMaxDiskSamples, 2);
    checks.push_back({static_cast<PatternTable>(table), at - table * kMaxDiskSamples + 1, false});
  }
  make_executor()->parallel_for(count, [&](int i, int) {
    checks[i].good = pattern_ships_as_made(checks[i].table, checks[i].samples);
  });
  std::string differing;
  for (const Check& c : checks) {
    if (c.good) continue;
    differing +=
        fmt::format("{}{} of {}", differing.empty() ? "" : ", ", enum_name(c.table), c.samples);
  }
  if (differing.empty()) return {};
  return {StatusCode::kInternal, "these patterns are no longer made as they ship: " + differing};
}

}  // namespace obscura::tools
