// obscura bench: Google Benchmark, with its own flags.
#include <memory>

#include "apps/obscura/app.h"
#ifdef OBSCURA_WITH_BENCH
#include "bench/run_benchmarks.h"
#endif

namespace obscura::app {

#ifdef OBSCURA_WITH_BENCH
void add_bench(App& app) {
  auto flags = std::make_shared<CLI::App*>(nullptr);
  *flags = app.add_command(
      "bench",
      "Run the benchmarks; takes the flags of Google Benchmark (--benchmark_filter=REGEX, "
      "--benchmark_out=FILE.json, --benchmark_list_tests)",
      [flags, &app] {
        std::vector<std::string> arguments = (*flags)->remaining();
        arguments.insert(arguments.begin(), "obscura bench");
        std::vector<char*> argv;
        for (std::string& a : arguments) argv.push_back(a.data());
        argv.push_back(nullptr);
        app.exit_code = bench::run(static_cast<int>(arguments.size()), argv.data());
        return Status();
      });
  (*flags)->allow_extras();
}
#else
void add_bench(App& app) {
  app.add_command("bench", "Run the benchmarks (not in this build)", [] {
    return unsupported("this build has no benchmarks; configure it with OBSCURA_BUILD_BENCH=ON");
  });
}
#endif

}  // namespace obscura::app
