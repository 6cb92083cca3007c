// Images as files, and how two of them differ.
#include "files/module.h"
#include "io/images/files.h"
#include "library/run.h"
#include "scene/truth/compare.h"

namespace obscura::python {
namespace {

// (name, array) of each channel.
std::vector<std::pair<std::string, py::array>> read_channels(const std::string& path) {
  tools::Image image;
  run(1, py::none(), [&](const RunOptions&) { return tools::read_image(path, &image); });
  std::vector<std::pair<std::string, py::array>> channels;
  for (const auto& c : image.channels) {
    channels.emplace_back(c.name, to_array(c.values, {image.height, image.width}));
  }
  return channels;
}

void write_channels(const std::string& path,
                    const std::vector<std::pair<std::string, py::object>>& channels, bool half,
                    int png_bits) {
  tools::Image image;
  for (const auto& [name, array] : channels) {
    const ImageView<const float> view = python::image(name.c_str(), array);
    if (image.channels.empty()) image = tools::Image(view.width, view.height);
    if (view.width != image.width || view.height != image.height) {
      throw py::value_error(name + " has another size than the first channel");
    }
    std::vector<float>& values = image.add(name);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        values[static_cast<std::size_t>(y) * view.width + x] = view(x, y);
      }
    }
  }
  tools::WriteOptions options;
  options.half = half;
  options.png_bits = png_bits;
  raise(tools::check_image_ending(path));
  Status status;
  run(1, py::none(), [&](const RunOptions&) {
    status = tools::write_image(path, image, options);
    return Status();
  });
  raise_of_file(status);
}

std::vector<std::pair<std::string, double>> difference(const py::object& image_array,
                                                       const py::object& reference,
                                                       const py::object& mask) {
  const auto a = image("image", image_array), b = image("reference", reference);
  const auto m = image("mask", mask);
  tools::Comparison c;
  run(1, py::none(), [&](const RunOptions&) { return tools::compare(a, b, m, &c); });
  return {{"e_a", c.e_a},
          {"within_5", c.within_5},
          {"bias", c.bias},
          {"rmse", c.rmse},
          {"maximum", c.maximum},
          {"correlation", c.correlation},
          {"pixels", static_cast<double>(c.pixels)},
          {"infinite", static_cast<double>(c.infinite)}};
}

}  // namespace

void add_images(py::module_& m) {
  m.def("read_channels", &read_channels);
  m.def("write_channels", &write_channels);
  m.def("difference", &difference);
}

}  // namespace obscura::python
