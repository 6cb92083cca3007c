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
  std::string kind = "disk", table;
  int check = 0;
  OptionTable options;
};

Status run_patterns(const PatternsCommand& c, bool quiet) {
  tools::ProgressBar bar("patterns", !quiet);
  const auto progress = [&bar](double share) { bar(share); };
  if (c.check > 0) return tools::check_patterns(c.check);
  if (!c.table.empty()) {
    tools::PatternTable table;
    if (Status s = parse_setting("--table", Field{"table", "", {}, ""}, c.table, &table); !s.ok()) {
      return s;
    }
    std::fputs(tools::make_pattern_table(table, progress).c_str(), stdout);
    return {};
  }
  if (c.kind != "disk" && c.kind != "ball") {
    return invalid_argument("--kind is '" + c.kind + "'; it must be one of disk, ball");
  }
  PatternSettings settings;
  if (Status s = c.options.read(&settings); !s.ok()) return s;
  tools::Json json;
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
  command
      ->add_option("--table", c->table,
                   "Print one of the tables that ship instead, made again; takes minutes: disks, "
                   "centered-disks or balls")
      ->type_name("NAME");
  command
      ->add_option("--check", c->check,
                   "Make N of the 128 patterns that ship again and compare them [1 to 128]")
      ->check(CLI::Range(1, tools::kShippedPatterns))
      ->type_name("N");
  c->options.declare("patterns", PatternSettings{});
  c->options.add_to(command, "Pattern");
}

}  // namespace obscura::app
