// obscura._files: files, meshes, scenes and pictures of volumes, for the Python files beside it.
#include "files/module.h"

#include <algorithm>

namespace obscura::python {

void raise_of_file(const Status& status) {
  if (status.code() != StatusCode::kInvalidInput) return raise(status);
  PyErr_SetString(PyExc_OSError, status.message().c_str());
  throw py::error_already_set();
}

py::array_t<float> to_array(const std::vector<float>& values,
                            const std::vector<py::ssize_t>& shape) {
  py::array_t<float> array(shape);
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

PYBIND11_MODULE(_files, m) {
  m.doc() = "The part of obscura that reads files; use the package.";
  add_images(m);
  add_mesh_points(m);
  add_views(m);
  add_volume_files(m);
}

}  // namespace obscura::python
