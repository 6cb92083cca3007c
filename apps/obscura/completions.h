#ifndef OBSCURA_APPS_OBSCURA_COMPLETIONS_H_
#define OBSCURA_APPS_OBSCURA_COMPLETIONS_H_

#include <string>

#include "CLI/CLI.hpp"

namespace obscura::app {

// A script that completes commands, options and their words in `shell`: bash, zsh or fish; "" for
// another.
std::string completion_script(const CLI::App& cli, const std::string& shell);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_COMPLETIONS_H_
