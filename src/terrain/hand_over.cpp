#include "terrain/hand_over.h"

#include <cmath>

namespace obscura {

std::span<const LinePoint> HandOver::before(int column, int entry, int worker) {
  const TerrainSweep& sweep = direction_.sweep;
  if (!from_) return {};
  // Rows of the model are the grid's columns where it is transposed: lines cross the border in the
  // row before their entry. Else they cross it all before the first row.
  int index = entry - 1;
  if (!direction_.transposed) {
    if (entry > 0) return {};
    index = column + static_cast<int>(std::floor(sweep.line(-1) + 0.5));
    if (index >= sweep.width) return {};
  }
  if (index < 0) return {};
  auto& points = points_[worker];
  points.clear();
  if (Status s = from_->get(index, &points); !s.ok()) {
    fail(s);
    return {};
  }
  // Chains lead to ever earlier rows: what was kept elsewhere is not believed.
  int last = first_row() + entry;
  bool valid = !points.empty() && points[0].row == last - 1;
  for (LinePoint& p : points) {
    valid = valid && p.row >= 0 && p.row < last;
    last = p.row;
    p.row -= first_row();
  }
  if (valid) return points;
  fail(invalid_input("hulls that a band has kept are not those of this model"));
  return {};
}

void HandOver::leave(int row, int x, std::span<const LinePoint> hull, int worker) {
  auto& points = points_[worker];
  points.clear();
  for (const LinePoint& p : hull) points.push_back({p.height, p.row + first_row()});
  if (Status s = to_->put(direction_.transposed ? row : x, points); !s.ok()) fail(s);
}

void HandOver::fail(const Status& status) {
  if (!failed_.exchange(true)) status_ = status;
}

}  // namespace obscura
