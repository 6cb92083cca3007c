#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_VOLUME_ARRAYS_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_VOLUME_ARRAYS_H_

#include "library/arrays.h"
#include "obscura/volume.h"

namespace obscura::python {

// An array (Z, Y, X), whose last axis is x, in place; TypeError and ValueError as in arrays.h.
// `spacing_zyx` is in the order of its axes. Samples are uint8, int16, uint16 or float32.
VolumeView volume_view(const py::object& object, const std::array<double, 3>& spacing_zyx,
                       double slope, double intercept);
// The same of float32.
GridView<const float> float_grid(const char* name, const py::object& object,
                                 const std::array<double, 3>& spacing_zyx);

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_LIBRARY_VOLUME_ARRAYS_H_
