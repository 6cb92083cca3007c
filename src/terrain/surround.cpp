#include "terrain/surround.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "terrain/check_terrain.h"

namespace obscura {

bool SurroundLines::coarse_position(double column, int row, double* x, double* y) const {
  const TerrainSweep& sweep = direction_.sweep;
  const TerrainSurround& s = model_.surround;
  double across = column, down = sweep.reversed ? sweep.height - 1 - row : row;
  if (direction_.transposed) std::swap(across, down);
  across += static_cast<double>(s.column);
  down += static_cast<double>(s.row);
  // Coarse cell i spans the cells from i * factor on; the last may reach beyond the model.
  *x = (across + 0.5) / s.factor - 0.5;
  *y = (down + 0.5) / s.factor - 0.5;
  return across >= -0.5 && down >= -0.5 && across <= static_cast<double>(s.width) - 0.5 &&
         down <= static_cast<double>(s.height) - 0.5;
}

float SurroundLines::height_at(double x, double y) const {
  const auto& h = model_.surround.heights;
  x = std::clamp(x, 0.0, h.width - 1.0);
  y = std::clamp(y, 0.0, h.height - 1.0);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const int i1 = std::min(i + 1, h.width - 1), j1 = std::min(j + 1, h.height - 1);
  const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
  const float top = h(i, j) + u * (h(i1, j) - h(i, j)), low = h(i, j1) + u * (h(i1, j1) - h(i, j1));
  const float between = top + v * (low - top);
  if (!std::isnan(between)) return between;
  return h(u < 0.5f ? i : i1, v < 0.5f ? j : j1);
}

std::span<const LinePoint> SurroundLines::before(int column, int entry, int worker) {
  std::vector<LinePoint>& points = points_[worker];
  points.clear();
  const TerrainSweep& sweep = direction_.sweep;
  const int step = model_.surround.factor;
  // The row before the entry is that of the chain's own end.
  int row = static_cast<int>(std::floor((entry - 2.0) / step)) * step, last = row + step;
  double x, y;
  for (; row >= -sweep.rows_before && coarse_position(column + sweep.line(row), row, &x, &y);
       row -= step) {
    last = row;
  }
  // From the far end on, each point takes away those that it hides.
  for (row = last; row <= entry - 2; row += step) {
    coarse_position(column + sweep.line(row), row, &x, &y);
    const float height = height_at(x, y);
    if (std::isnan(height)) continue;
    const double bend = direction_.offset(sweep.first_row + row);
    const LinePoint p{static_cast<float>(factor_ * (height - base_) + bend), row};
    while (points.size() >= 2) {
      const LinePoint &near = points.back(), &far = points[points.size() - 2];
      if ((far.height - p.height) * static_cast<float>(p.row - near.row) <=
          (near.height - p.height) * static_cast<float>(p.row - far.row)) {
        break;
      }
      points.pop_back();
    }
    points.push_back(p);
  }
  std::ranges::reverse(points);
  return points;
}

Status coarsen_terrain(const ElevationModel& model, int factor, ImageView<float> coarse) {
  const auto& h = model.heights;
  if (h.empty() || coarse.empty()) return invalid_input("heights or coarse are missing");
  if (factor < 1 || factor > 65536) {
    return invalid_argument(text("factor is ", factor, "; it must be in [1, 65536]"));
  }
  const Extent size = {(h.width + factor - 1) / factor, (h.height + factor - 1) / factor};
  if (coarse.width != size.width || coarse.height != size.height) {
    return invalid_input(text("coarse is ", coarse.width, "x", coarse.height, "; it must be ",
                              size.width, "x", size.height));
  }
  for (int j = 0; j < size.height; ++j) {
    for (int i = 0; i < size.width; ++i) {
      double sum = 0, most = -std::numeric_limits<double>::infinity();
      int count = 0;
      for (int y = j * factor; y < std::min(h.height, (j + 1) * factor); ++y) {
        for (int x = i * factor; x < std::min(h.width, (i + 1) * factor); ++x) {
          if (!has_height(model, h(x, y))) continue;
          sum += h(x, y);
          most = std::max<double>(most, h(x, y));
          ++count;
        }
      }
      coarse(i, j) = count > 0 ? static_cast<float>(0.5 * (sum / count + most))
                               : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return {};
}

}  // namespace obscura
