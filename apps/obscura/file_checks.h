#ifndef OBSCURA_APPS_OBSCURA_FILE_CHECKS_H_
#define OBSCURA_APPS_OBSCURA_FILE_CHECKS_H_

#include "CLI/CLI.hpp"
#include "obscura/status.h"

namespace obscura::app {

// Looks at the files that a command line names, before any work: an output must not be another
// output or an input (--into, and --output with --keep-channels, may be INPUT), and its folder must
// be there and writable. Pipes, devices and - as outputs are taken as they are.
Status check_files(const CLI::App& command);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_FILE_CHECKS_H_
