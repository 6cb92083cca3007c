#ifndef OBSCURA_BINDINGS_PYTHON_FILES_MODULE_H_
#define OBSCURA_BINDINGS_PYTHON_FILES_MODULE_H_

#include <vector>

#include "library/settings.h"

namespace obscura::python {

// Each part of the module adds its functions.
void add_images(py::module_& m);
void add_mesh_points(py::module_& m);
void add_views(py::module_& m);
void add_volume_files(py::module_& m);

// After writing: what is wrong with a file is an OSError, a wrong argument a ValueError.
void raise_of_file(const Status& status);

// A new array of this shape with these values.
py::array_t<float> to_array(const std::vector<float>& values,
                            const std::vector<py::ssize_t>& shape);

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_FILES_MODULE_H_
