#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_ARRAYS_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_ARRAYS_H_

#include <pybind11/numpy.h>

#include <string>

#include "obscura/status.h"
#include "obscura/views.h"

namespace obscura::python {

namespace py = pybind11;

std::string shape_text(const py::array& a);

// The object as the array that it is; TypeError for what is none, or a masked one. `types` and
// `shape` say what is wanted.
py::array typed_array(const std::string& name, const py::object& object, const char* types,
                      const char* shape);
// TypeError for another type than float32 in the machine's byte order.
void check_float(const std::string& name, const py::array& array);
// ValueError for another count of dimensions or a side that is too long.
void check_shape(const std::string& name, const py::array& array, int dimensions, int longest,
                 const char* shape);
// From one sample to the next along an axis, in samples; TypeError where that is no whole number.
py::ssize_t step_of(const std::string& name, const py::array& array, int axis);

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
