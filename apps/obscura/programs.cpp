#include "apps/obscura/programs.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "fmt/format.h"

namespace obscura::app {
namespace {

struct Program {
  std::string_view command;
  const char* summary;
};
constexpr Program kPrograms[] = {
    {"bench",
     "Run the benchmarks; takes the flags of Google Benchmark (--benchmark_filter=REGEX, ...)"},
    {"reproduce", "Measure one of the papers' tables or figures again: Markdown, JSON, pictures"},
};

}  // namespace

void add_programs(App& app) {
  for (const Program& p : kPrograms) {
    CLI::App* command = app.add_command(std::string(p.command), p.summary, [&p] {
      return unsupported(fmt::format(
          "there is no obscura-{0} beside this command or on PATH; build it: `./run build`, or "
          "`cmake --build FOLDER --target obscura-{0}`",
          p.command));
    });
    command->allow_extras();
  }
}

void run_program(char** argv) {
  if (!argv[0] || !argv[1]) return;
  if (std::ranges::find(kPrograms, std::string_view(argv[1]), &Program::command) ==
      std::end(kPrograms)) {
    return;
  }
  std::string name = fmt::format("obscura-{}", argv[1]);
  std::vector<char*> arguments = {name.data()};
  for (char** a = argv + 2; *a; ++a) arguments.push_back(*a);
  arguments.push_back(nullptr);
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  execv((self.parent_path() / name).c_str(), arguments.data());
  execvp(name.c_str(), arguments.data());
}

}  // namespace obscura::app
