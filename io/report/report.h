#ifndef OBSCURA_IO_REPORT_REPORT_H_
#define OBSCURA_IO_REPORT_REPORT_H_

#include <optional>
#include <string>
#include <vector>

#include "io/report/json.h"
#include "obscura/status.h"

namespace obscura::tools {

// The one shape of every JSON that Obscura writes:
// {"rows": [{"name", "metric", "value", "unit", "bound"?}], "machine": {...}, "settings": {...}}.
struct Report {
  struct Row {
    std::string name;    // what was measured: a method, a scene, a file
    std::string metric;  // e_A, time, ...
    double value = 0;    // NaN and infinities are written as null
    std::string unit;
    std::optional<double> bound = {};  // what the value is held against
  };

  std::vector<Row> rows;
  Json settings = Json::object();

  void add(std::string name, std::string metric, double value, std::string unit = "",
           std::optional<double> bound = {}) {
    rows.push_back({std::move(name), std::move(metric), value, std::move(unit), bound});
  }

  Json json() const;
  std::string to_json() const;  // as text

  // A Markdown table with one line per name and one column per metric, in order of appearance.
  std::string to_markdown() const;
};

// Processor, threads, SIMD target, compiler and version of Obscura.
Json describe_machine();

}  // namespace obscura::tools

#endif  // OBSCURA_IO_REPORT_REPORT_H_
