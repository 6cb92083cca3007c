#include "io/patterns/pattern_files.h"

#include "fmt/format.h"
#include "io/patterns/quality.h"
#include "io/report/report.h"

namespace obscura::tools {
namespace {

void add_quality(const std::string& name, const PatternQuality& q, Report* report) {
  report->add(name, "half-spaces, rms", q.half_spaces, "% of the sphere");
  report->add(name, "steps, rms", q.steps, "% of the sphere");
  report->add(name, "both, rms", q.both(), "% of the sphere");
}

std::string row(const DiskSample& s) {
  return fmt::format("    {{{:.8e}f, {:.8e}f, {:.8e}f, {:.8e}f}},\n", s.x, s.y, s.weight_constant,
                     s.weight_quadratic);
}
std::string row(const BallSample& s) {
  return fmt::format("    {{{:.8e}f, {:.8e}f, {:.8e}f, {:.8e}f, {:.8e}f}},\n", s.x, s.y, s.z,
                     s.weight_constant, s.weight_quadratic);
}

}  // namespace

Status describe_pattern(bool ball, const PatternSettings& settings, nlohmann::ordered_json* json) {
  Report report;
  nlohmann::ordered_json samples = nlohmann::ordered_json::array();
  const std::string name = fmt::format("{} {}{}", ball ? "ball" : "disk", settings.count,
                                       settings.center && !ball ? ", center" : "");
  if (ball) {
    std::vector<BallSample> pattern;
    if (Status s = make_ball_pattern(settings, &pattern); !s.ok()) return s;
    add_quality(name, quality(std::span<const BallSample>(pattern)), &report);
    for (const BallSample& s : pattern) {
      samples.push_back({s.x, s.y, s.z, s.weight_constant, s.weight_quadratic});
    }
  } else {
    std::vector<DiskSample> pattern;
    if (Status s = make_disk_pattern(settings, &pattern); !s.ok()) return s;
    add_quality(name, quality(std::span<const DiskSample>(pattern)), &report);
    for (const DiskSample& s : pattern) {
      samples.push_back({s.x, s.y, s.weight_constant, s.weight_quadratic});
    }
  }
  visit_fields(settings,
               [&](const auto& value, const Field& field) { report.settings[field.name] = value; });
  report.settings["kind"] = ball ? "ball" : "disk";
  *json = nlohmann::ordered_json::parse(report.to_json());
  (*json)["samples"] = std::move(samples);
  return {};
}

std::string pattern_tables_source(const std::function<void(double)>& progress) {
  const double work = 2 * kMaxDiskSamples + kMaxBallSamples;
  int done = 0;
  auto advance = [&] {
    ++done;
    if (progress) progress(done / work);
  };
  std::string source =
      "// Made by `obscura patterns --tables` from the default settings; not edited by hand.\n"
      "#include \"math/pattern_tables.h\"\n\n"
      "namespace obscura::math {\n\n"
      "// clang-format off\n";
  for (const bool center : {false, true}) {
    source += fmt::format("const DiskSample {}[] = {{\n", center ? "kCenteredDisks" : "kDisks");
    for (int count = 1; count <= kMaxDiskSamples; ++count, advance()) {
      PatternSettings settings;
      settings.count = count;
      settings.center = center;
      std::vector<DiskSample> pattern;
      (void)make_disk_pattern(settings, &pattern);
      for (const DiskSample& s : pattern) source += row(s);
    }
    source += "};\n\n";
  }
  source += "const BallSample kBalls[] = {\n";
  for (int count = 1; count <= kMaxBallSamples; ++count, advance()) {
    PatternSettings settings;
    settings.count = count;
    std::vector<BallSample> pattern;
    (void)make_ball_pattern(settings, &pattern);
    for (const BallSample& s : pattern) source += row(s);
  }
  return source + "};\n// clang-format on\n\n}  // namespace obscura::math\n";
}

}  // namespace obscura::tools
