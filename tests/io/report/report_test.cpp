#include "io/report/report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nlohmann/json.hpp"

namespace obscura::tools {
namespace {

TEST(Report, JsonHasTheOneShape) {
  Report report;
  report.add("hall", "e_A", 1.25, "%", 2.0);
  report.add("hall", "time", NAN, "ms");
  report.settings["radius"] = 2;
  const auto json = nlohmann::json::parse(report.to_json());
  EXPECT_EQ(json["rows"][0]["name"], "hall");
  EXPECT_EQ(json["rows"][0]["metric"], "e_A");
  EXPECT_EQ(json["rows"][0]["value"], 1.25);
  EXPECT_EQ(json["rows"][0]["unit"], "%");
  EXPECT_EQ(json["rows"][0]["bound"], 2.0);
  EXPECT_TRUE(json["rows"][1]["value"].is_null());
  EXPECT_FALSE(json["rows"][1].contains("bound"));
  EXPECT_TRUE(json["machine"].contains("processor"));
  EXPECT_EQ(json["settings"]["radius"], 2);
}

TEST(Report, MarkdownHasARowPerNameAndAColumnPerMetric) {
  Report report;
  report.add("a", "e_A", 1.23456, "%");
  report.add("b", "e_A", 2, "%");
  report.add("b", "time", 1500000, "ns");
  EXPECT_EQ(report.to_markdown(),
            "| | e_A (%) | time (ns) |\n|---|---:|---:|\n| a | 1.235 |  |\n| b | 2 | 1500000 |\n");
}

}  // namespace
}  // namespace obscura::tools
