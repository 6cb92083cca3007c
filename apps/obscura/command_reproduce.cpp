// obscura reproduce: the papers' tables and figures, measured again.
#include <filesystem>
#include <memory>

#include "apps/obscura/app.h"
#include "fmt/format.h"
#include "io/report/progress_bar.h"
#include "reproduce/reproduce.h"

namespace obscura::app {
namespace {

struct ReproduceCommand {
  std::string name, folder = "reproduce", data;
  int threads = 0;
};

std::string reproduction_names() {
  std::string names;
  for (const tools::Reproduction& r : tools::reproductions()) {
    names += (names.empty() ? "" : ", ") + std::string(r.name);
  }
  return names;
}

Status run_reproduce(const ReproduceCommand& c, bool quiet) {
  for (const tools::Reproduction& r : tools::reproductions()) {
    if (c.name != r.name) continue;
    if (!c.data.empty() && !std::filesystem::is_directory(c.data)) {
      return invalid_input(fmt::format("--data {} is not a folder", c.data));
    }
    std::error_code error;
    std::filesystem::create_directories(c.folder, error);
    if (error) {
      return {StatusCode::kInternal,
              fmt::format("cannot make the folder {}: {}", c.folder, error.message())};
    }
    tools::ProgressBar bar(c.name, !quiet);
    const tools::ReproduceContext context(
        c.folder, c.name, c.threads, c.data,
        [&bar](const std::string&, double share) { return bar(share); });
    if (Status s = tools::reproduce(r, c.folder, context); !s.ok()) return s;
    if (!quiet) fmt::print("{0}/{1}.md, {0}/{1}.json\n", c.folder, c.name);
    return {};
  }
  return invalid_argument(
      fmt::format("there is no reproduction '{}'; there are {}", c.name, reproduction_names()));
}

}  // namespace

void add_reproduce(App& app) {
  auto c = std::make_shared<ReproduceCommand>();
  CLI::App* command = app.add_command(
      "reproduce", "Measure one of the papers' tables or figures again: Markdown, JSON, pictures",
      [c, &app] { return run_reproduce(*c, app.quiet); });
  command->add_option("NAME", c->name, reproduction_names())->required()->type_name("");
  command->add_option("-o,--output", c->folder, "Folder for what it makes [default reproduce]")
      ->type_name("FOLDER");
  command
      ->add_option("--data", c->data,
                   "Folder with further inputs: meshes/kitchen.ply, depth/*.pfm, volumes/*.nii.gz")
      ->type_name("FOLDER");
  add_threads_option(command, &c->threads);
}

}  // namespace obscura::app
