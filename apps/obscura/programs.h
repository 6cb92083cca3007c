#ifndef OBSCURA_APPS_OBSCURA_PROGRAMS_H_
#define OBSCURA_APPS_OBSCURA_PROGRAMS_H_

#include "apps/obscura/app.h"

// Commands that are programs of their own, built on request: `obscura bench ...` runs
// `obscura-bench ...`, found beside this program or on PATH.
namespace obscura::app {

// Adds them; where one is called for all the same, it is not there, and the command says how to
// build it.
void add_programs(App& app);

// Becomes the program of argv[1] if that is one, with the arguments that follow. Returns where it
// is none or not there.
void run_program(char** argv);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_PROGRAMS_H_
