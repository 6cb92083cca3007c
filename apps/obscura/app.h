#ifndef OBSCURA_APPS_OBSCURA_APP_H_
#define OBSCURA_APPS_OBSCURA_APP_H_

#include <functional>
#include <string>

#include "CLI/CLI.hpp"
#include "obscura/status.h"

namespace obscura::app {

enum ExitCode { kDone = 0, kFailure = 1, kBadUsage = 2, kBadInput = 3 };

// What a subcommand leaves behind: the action that main runs once the command line is parsed.
struct App {
  CLI::App cli{"Ambient visibility from depth images, meshes and volumes", "obscura"};
  bool quiet = false;
  std::function<Status()> action;

  // Adds a subcommand with --quiet; `run` is called when the user has chosen it.
  CLI::App* add_command(const std::string& name, const std::string& description,
                        std::function<Status()> run);
};

// --threads, for every command that computes.
void add_threads_option(CLI::App* command, int* threads);

// Each adds its subcommand; see the file of the same name.
void add_ao(App& app);
void add_bake(App& app);
void add_compare(App& app);
void add_demo(App& app);
void add_gbuffer(App& app);
void add_info(App& app);
void add_light(App& app);
void add_manual(App& app);
void add_patterns(App& app);
void add_settings(App& app);
void add_terrain(App& app);
void add_volume(App& app);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_APP_H_
