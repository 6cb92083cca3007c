#include "library/volume_arrays.h"

namespace obscura::python {
namespace {

constexpr int kMaxSide = 8192;

}  // namespace

VolumeView volume_view(const py::object& object, const std::array<double, 3>& spacing_zyx,
                       double slope, double intercept) {
  const py::array a = typed_array("volume", object, "uint8, int16, uint16 or float32", "(Z, Y, X)");
  VolumeView v;
  const py::dtype type = a.dtype();
  if (type.equal(py::dtype::of<std::uint8_t>())) {
    v.type = VoxelType::kU8;
  } else if (type.equal(py::dtype::of<std::int16_t>())) {
    v.type = VoxelType::kI16;
  } else if (type.equal(py::dtype::of<std::uint16_t>())) {
    v.type = VoxelType::kU16;
  } else if (!type.equal(py::dtype::of<float>())) {
    throw py::type_error("volume is " + std::string(py::str(a.attr("dtype"))) +
                         "; it must be uint8, int16, uint16 or float32: "
                         "volume.astype(numpy.float32)");
  }
  check_shape("volume", a, 3, kMaxSide, "(Z, Y, X)");
  v.data = a.data();
  for (int i = 0; i < 3; ++i) {
    v.size[i] = static_cast<int>(a.shape(2 - i));
    v.spacing[i] = static_cast<float>(spacing_zyx[2 - i]);
    v.stride[i] = step_of("volume", a, 2 - i);
  }
  v.slope = static_cast<float>(slope);
  v.intercept = static_cast<float>(intercept);
  return v;
}

GridView<const float> float_grid(const char* name, const py::object& object,
                                 const std::array<double, 3>& spacing_zyx) {
  const py::array a = typed_array(name, object, "float32", "(Z, Y, X)");
  check_float(name, a);
  check_shape(name, a, 3, kMaxSide, "(Z, Y, X)");
  GridView<const float> g;
  g.data = static_cast<const float*>(a.data());
  for (int i = 0; i < 3; ++i) {
    g.size[i] = static_cast<int>(a.shape(2 - i));
    g.spacing[i] = static_cast<float>(spacing_zyx[2 - i]);
    g.stride[i] = step_of(name, a, 2 - i);
  }
  return g;
}

}  // namespace obscura::python
