#include "library/arrays.h"

#include <new>

namespace obscura::python {
namespace {

// The array itself, once it is known to be what the library can read as it is.
py::array checked(const std::string& name, const py::object& object, int dimensions) {
  const char* shape = dimensions == 2 ? "(H, W)" : "(H, W, 3)";
  const py::array array = typed_array(name, object, "float32", shape);
  check_float(name, array);
  if (dimensions == 3 && array.ndim() == 3 && array.shape(2) != 3) {
    throw py::value_error(name + " has shape " + shape_text(array) +
                          "; it must be a float32 array of shape (H, W, 3)");
  }
  check_shape(name, array, dimensions, 65535, shape);
  for (int i = 0; i < dimensions; ++i) step_of(name, array, i);
  return array;
}

template <class T>
ImageView<T> view(T* data, const py::array& a) {
  const auto step = static_cast<py::ssize_t>(sizeof(float));
  return {data, static_cast<int>(a.shape(1)), static_cast<int>(a.shape(0)), a.strides(0) / step,
          a.strides(1) / step};
}

template <class T>
VectorView<T> vector_view(T* data, const py::array& a) {
  const py::ssize_t next = a.strides(2) / static_cast<py::ssize_t>(sizeof(float));
  return {view(data, a), view(data + next, a), view(data + 2 * next, a)};
}

py::array checked_out(const std::string& name, const py::array& array, int dimensions,
                      Extent size) {
  const py::array a = checked(name, array, dimensions);
  if (!a.writeable()) throw py::value_error(name + " is read-only; it must be writeable");
  if (a.shape(0) != size.height || a.shape(1) != size.width) {
    throw py::value_error(name + " has shape " + shape_text(a) + "; its image has " +
                          std::to_string(size.height) + " rows and " + std::to_string(size.width) +
                          " columns");
  }
  return a;
}

}  // namespace

std::string shape_text(const py::array& a) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < a.ndim(); ++i) {
    text += (i ? ", " : "") + std::to_string(a.shape(i));
  }
  return text + (a.ndim() == 1 ? ",)" : ")");
}

py::array typed_array(const std::string& name, const py::object& object, const char* types,
                      const char* shape) {
  if (!py::isinstance<py::array>(object)) {
    const auto type = py::str(py::type::of(object).attr("__name__")).cast<std::string>();
    throw py::type_error(name + " is a " + type + "; it must be a " + types + " array of shape " +
                         shape);
  }
  if (py::hasattr(object, "mask")) {
    throw py::type_error(name +
                         " is a masked array; give .filled(numpy.inf), so that what is "
                         "masked is background");
  }
  return py::reinterpret_borrow<py::array>(object);
}

void check_float(const std::string& name, const py::array& array) {
  if (array.dtype().equal(py::dtype::of<float>())) return;
  throw py::type_error(name + " is " + py::str(array.dtype()).cast<std::string>() +
                       "; it must be float32: " + name + ".astype(numpy.float32)");
}

void check_shape(const std::string& name, const py::array& array, int dimensions, int longest,
                 const char* shape) {
  if (array.ndim() != dimensions) {
    throw py::value_error(name + " has shape " + shape_text(array) + "; it must be " + shape);
  }
  for (int i = 0; i < dimensions; ++i) {
    if (array.shape(i) > longest) {
      throw py::value_error(name + " has shape " + shape_text(array) +
                            "; each side must be at most " + std::to_string(longest));
    }
  }
}

py::ssize_t step_of(const std::string& name, const py::array& array, int axis) {
  if (array.strides(axis) % array.itemsize() != 0) {
    throw py::type_error(name + " has a step of " + std::to_string(array.strides(axis)) +
                         " bytes, no whole number of " + std::to_string(array.itemsize()) +
                         "-byte samples; numpy.ascontiguousarray copies it");
  }
  return array.strides(axis) / array.itemsize();
}

ImageView<const float> image(const char* name, const py::object& object) {
  if (object.is_none()) return {};
  const py::array a = checked(name, object, 2);
  return view(static_cast<const float*>(a.data()), a);
}

VectorView<const float> vectors(const char* name, const py::object& object) {
  if (object.is_none()) return {};
  const py::array a = checked(name, object, 3);
  return vector_view(static_cast<const float*>(a.data()), a);
}

ImageView<float> image_out(const std::string& name, const py::array& array, Extent size) {
  py::array a = checked_out(name, array, 2, size);
  return view(static_cast<float*>(a.mutable_data()), a);
}

VectorView<float> vectors_out(const std::string& name, const py::array& array, Extent size) {
  py::array a = checked_out(name, array, 3, size);
  return vector_view(static_cast<float*>(a.mutable_data()), a);
}

void raise(const Status& status) {
  switch (status.code()) {
    case StatusCode::kOk:
      return;
    case StatusCode::kInvalidArgument:
    case StatusCode::kInvalidInput:
    case StatusCode::kUnsupported:
      throw py::value_error(status.message());
    case StatusCode::kOutOfMemory:
      PyErr_SetString(PyExc_MemoryError, status.message().c_str());
      throw py::error_already_set();
    default:
      PyErr_SetString(PyExc_RuntimeError, status.message().c_str());
      throw py::error_already_set();
  }
}

}  // namespace obscura::python
