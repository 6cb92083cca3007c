// obscura patterns: sample patterns made by the paper's method, and the tables that ship.
#include <cstdio>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/option_table.h"
#include "io/patterns/pattern_files.h"
#include "io/report/progress_bar.h"

namespace obscura::app {
namespace {

struct PatternsCommand {
  std::string kind = "disk";
  bool tables = false;
  OptionTable options;
};

Status run_patterns(const PatternsCommand& c, bool quiet) {
  if (c.tables) {
    tools::ProgressBar bar("patterns", !quiet);
    std::fputs(tools::pattern_tables_source([&bar](double share) { bar(share); }).c_str(), stdout);
    return {};
  }
  if (c.kind != "disk" && c.kind != "ball") {
    return invalid_argument("--kind is '" + c.kind + "'; it must be one of disk, ball");
  }
  PatternSettings settings;
  if (Status s = c.options.read(&settings); !s.ok()) return s;
  nlohmann::ordered_json json;
  if (Status s = tools::describe_pattern(c.kind == "ball", settings, &json); !s.ok()) return s;
  std::puts(json.dump(2).c_str());
  return {};
}

}  // namespace

void add_patterns(App& app) {
  auto c = std::make_shared<PatternsCommand>();
  CLI::App* command = app.add_command(
      "patterns", "Make a sample pattern of volumetric obscurance and print it as JSON",
      [c, &app] { return run_patterns(*c, app.quiet); });
  command->add_option("--kind", c->kind, "disk (lines, areas) or ball (points) [default disk]")
      ->type_name("");
  command->add_flag("--tables", c->tables,
                    "Print the source of src/screen/volumetric/patterns/pattern_tables.cpp "
                    "instead: all patterns of the library, computed again; takes minutes");
  c->options.declare("patterns", PatternSettings{});
  c->options.add_to(command, "Pattern");
}

}  // namespace obscura::app
