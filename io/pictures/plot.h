#ifndef OBSCURA_IO_PICTURES_PLOT_H_
#define OBSCURA_IO_PICTURES_PLOT_H_

#include <string>
#include <vector>

namespace obscura::tools {

// A scatter or line plot with logarithmic axes, written as SVG text.
struct Plot {
  struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  // positive x, y; others are left out
    bool line = true;
  };

  std::string title, x_label, y_label;
  std::vector<Series> series;

  std::string to_svg() const;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PICTURES_PLOT_H_
