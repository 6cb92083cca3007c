#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_ARRAYS_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_ARRAYS_H_

#include <pybind11/numpy.h>

#include <string>

#include "obscura/status.h"
#include "obscura/views.h"

namespace obscura::python {

namespace py = pybind11;

// Views of NumPy arrays, without a copy; strides as they are. Refused by TypeError that names the
// array, what it is and what is wanted: another type than float32 in the machine's byte order, a
// masked array, a step that is no whole number of floats; by ValueError: another shape. None gives
// an empty view.
ImageView<const float> image(const char* name, const py::object& array);
VectorView<const float> vectors(const char* name, const py::object& array);

// The same for results: (H, W) or (H, W, 3) of the size given, writeable.
ImageView<float> image_out(const std::string& name, const py::array& array, Extent size);
VectorView<float> vectors_out(const std::string& name, const py::array& array, Extent size);

// Raises what a Status that is not ok stands for: ValueError, MemoryError, KeyboardInterrupt,
// RuntimeError, with its own sentence.
void raise(const Status& status);

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_LIBRARY_ARRAYS_H_
