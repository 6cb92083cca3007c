// obscura-reproduce: the papers' tables and figures, measured again.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "fmt/format.h"
#include "io/report/progress_bar.h"
#include "obscura/simd.h"
#include "reproduce/reproduce.h"

namespace obscura::tools {
namespace {

struct Arguments {
  std::string name, folder = "reproduce", data;
  int threads = 0;
  bool quiet = false;
};

std::string reproduction_names() {
  std::string names;
  for (const Reproduction& r : reproductions()) {
    names += (names.empty() ? "" : ", ") + std::string(r.name);
  }
  return names;
}

Status run(const Arguments& a) {
  if (Status s = limit_simd_from_environment(); !s.ok()) return s;
  const auto& all = reproductions();
  const auto r = std::ranges::find_if(all, [&](const Reproduction& r) { return a.name == r.name; });
  if (r == all.end()) {
    return invalid_argument(
        fmt::format("there is no reproduction '{}'; there are {}", a.name, reproduction_names()));
  }
  if (!a.data.empty() && !std::filesystem::is_directory(a.data)) {
    return invalid_input(fmt::format("--data {} is not a folder", a.data));
  }
  std::error_code error;
  std::filesystem::create_directories(a.folder, error);
  if (error) {
    return {StatusCode::kInternal,
            fmt::format("cannot make the folder {}: {}", a.folder, error.message())};
  }
  ProgressBar bar(a.name, !a.quiet);
  const ReproduceContext context(a.folder, a.name, a.threads, a.data,
                                 [&bar](const std::string&, double share) { return bar(share); });
  if (Status s = reproduce(*r, a.folder, context); !s.ok()) return s;
  if (!a.quiet) fmt::print("{0}/{1}.md, {0}/{1}.json\n", a.folder, a.name);
  return {};
}

// As the obscura command: one line on stderr; 2 for wrong usage, 3 for a wrong input.
int report(const Status& status) {
  if (status.ok()) return 0;
  fmt::print(stderr, "obscura-reproduce: {}\n", status.message());
  switch (status.code()) {
    case StatusCode::kInvalidArgument:
    case StatusCode::kUnsupported:
      return 2;
    case StatusCode::kInvalidInput:
      return 3;
    default:
      return 1;
  }
}

int main(int argc, char** argv) {
  Arguments a;
  CLI::App cli("Measures the papers' tables and figures again: Markdown, JSON, pictures",
               "obscura-reproduce");
  cli.add_option("NAME", a.name, reproduction_names())->required()->type_name("");
  cli.add_option("-o,--output", a.folder, "Folder for what it makes [default reproduce]")
      ->type_name("FOLDER");
  cli.add_option("--data", a.data,
                 "Folder with further inputs: meshes/kitchen.ply, depth/*.pfm, volumes/*.nii.gz")
      ->type_name("FOLDER");
  cli.add_option("--threads", a.threads, "Threads; 0 uses all processors [0 to 1024, default 0]")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  cli.add_flag("-q,--quiet", a.quiet, "Print errors only");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return cli.exit(e);  // --help
  } catch (const CLI::ParseError& e) {
    return report(invalid_argument(e.what()));
  }
  catch_interrupts();
  return report(run(a));
}

}  // namespace
}  // namespace obscura::tools

int main(int argc, char** argv) {
  try {
    return obscura::tools::main(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "obscura-reproduce: out of memory\n");
    return 1;
  }
}
