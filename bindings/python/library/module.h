#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_MODULE_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_MODULE_H_

#include <pybind11/pybind11.h>

namespace obscura::python {

// Each part of the module adds its functions.
void add_light(pybind11::module_& m);
void add_terrain(pybind11::module_& m);
void add_volumes(pybind11::module_& m);

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_LIBRARY_MODULE_H_
