#include "io/report/report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "fmt/format.h"
#include "obscura/executor.h"
#include "obscura/simd.h"
#include "obscura/version.h"

namespace obscura::tools {
namespace {

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

// Four significant digits: what a table can bear.
std::string short_number(double v) {
  if (!std::isfinite(v)) return "-";
  const std::string text = fmt::format("{:.4g}", v);
  return text.find('e') == std::string::npos || std::abs(v) < 1e-4 ? text
                                                                   : fmt::format("{:.0f}", v);
}

template <class T>
void append_new(std::vector<T>* list, const T& item) {
  if (std::find(list->begin(), list->end(), item) == list->end()) list->push_back(item);
}

}  // namespace

Json Report::json() const {
  Json list = Json::array();
  for (const Row& r : rows) {
    Json row{{"name", r.name}, {"metric", r.metric}, {"value", r.value}, {"unit", r.unit}};
    if (r.bound) row["bound"] = *r.bound;
    list.push_back(std::move(row));
  }
  return {{"rows", std::move(list)}, {"machine", describe_machine()}, {"settings", settings}};
}

std::string Report::to_json() const { return json().dump(2) + "\n"; }

std::string Report::to_markdown() const {
  std::vector<std::string> names, columns;
  auto column = [](const Row& r) {
    return r.unit.empty() ? r.metric : fmt::format("{} ({})", r.metric, r.unit);
  };
  for (const Row& r : rows) {
    append_new(&names, r.name);
    append_new(&columns, column(r));
  }
  std::string out = "|";
  for (const std::string& c : columns) out += fmt::format(" | {}", c);
  out += " |\n|---|";
  for (std::size_t i = 0; i < columns.size(); ++i) out += "---:|";
  out += "\n";
  for (const std::string& n : names) {
    out += fmt::format("| {}", n);
    for (const std::string& c : columns) {
      const auto cell = std::find_if(rows.begin(), rows.end(),
                                     [&](const Row& r) { return r.name == n && column(r) == c; });
      out += " | ";
      if (cell != rows.end()) out += short_number(cell->value);
    }
    out += " |\n";
  }
  return out;
}

Json describe_machine() {
  return {{"processor", processor_name()}, {"threads", make_executor()->thread_count()},
          {"simd", simd_target()},         {"simd_targets", simd_targets()},
          {"simd_limit", simd_limit()},    {"compiler", compiler()},
          {"obscura", version()}};
}

}  // namespace obscura::tools
