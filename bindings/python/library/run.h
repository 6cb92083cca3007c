#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_RUN_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_RUN_H_

#include <pybind11/pybind11.h>

#include <functional>

#include "obscura/run_options.h"
#include "obscura/status.h"

namespace obscura::python {

// Runs `work` without the interpreter's lock, on a thread of its own, while the calling thread
// looks for Ctrl-C and tells `progress` (None, or a callable of the share done) some twenty times a
// second. An exception of either stops the work and is raised here; so is what a Status means.
void run(int threads, const pybind11::object& progress,
         const std::function<Status(const RunOptions&)>& work);

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_LIBRARY_RUN_H_
