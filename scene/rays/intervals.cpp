#include "scene/rays/intervals.h"

#include <algorithm>
#include <span>

namespace obscura::tools {
namespace {

using Hit = RayScene::Hit;

// One closed part's crossings, nearest first.
void add_solid(std::span<const Hit> hits, Vec3 direction, double sheet,
               std::vector<Interval>* matter) {
  auto enters = [&](const Hit& h) { return dot(h.normal, direction) < 0; };
  const auto entries = std::count_if(hits.begin(), hits.end(), enters);
  const bool balanced = 2 * entries == std::ptrdiff_t(hits.size());
  int depth = 0;
  double front = 0;
  for (const Hit& h : hits) {
    if (enters(h)) {
      if (depth == 0) front = h.t;
      depth = balanced ? depth + 1 : 1;
    } else if (depth == 0) {
      matter->push_back({h.t, h.t + sheet});
    } else if (--depth == 0) {
      matter->push_back({front, h.t});
    }
  }
  if (depth > 0) matter->push_back({front, front + sheet});
}

void merge(std::vector<Interval>* matter) {
  std::sort(matter->begin(), matter->end(), [](const Interval& a, const Interval& b) {
    return a.front != b.front ? a.front < b.front : a.back < b.back;
  });
  std::size_t count = 0;
  constexpr double kTouching = 1 + 1e-6;  // parts that share a face are one
  for (const Interval& i : *matter) {
    if (count > 0 && i.front <= (*matter)[count - 1].back * kTouching) {
      (*matter)[count - 1].back = std::max((*matter)[count - 1].back, i.back);
    } else {
      (*matter)[count++] = i;
    }
  }
  matter->resize(count);
}

}  // namespace

void find_matter(const RayScene& scene, Vec3 direction, double sheet, std::vector<Hit>* hits,
                 std::vector<Interval>* matter) {
  matter->clear();
  std::stable_sort(hits->begin(), hits->end(), [](const Hit& a, const Hit& b) {
    return a.part != b.part ? a.part < b.part : a.t < b.t;
  });
  for (std::size_t i = 0; i < hits->size();) {
    const int part = (*hits)[i].part;
    std::size_t end = i;
    while (end < hits->size() && (*hits)[end].part == part) ++end;
    if (scene.is_closed(part)) {
      add_solid(std::span(*hits).subspan(i, end - i), direction, sheet, matter);
    } else {
      for (std::size_t k = i; k < end; ++k) {
        matter->push_back({(*hits)[k].t, (*hits)[k].t + sheet});
      }
    }
    i = end;
  }
  merge(matter);
}

}  // namespace obscura::tools
