#include "scene/rays/solids.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace obscura::tools {
namespace {

using Index = std::uint32_t;

// For each vertex the smallest one in the same place.
std::vector<Index> weld(const Mesh& mesh) {
  std::vector<Index> order(mesh.positions.size()), representative(mesh.positions.size());
  std::iota(order.begin(), order.end(), Index(0));
  auto key = [&](Index i) {
    const Mesh::Point& p = mesh.positions[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    representative[order[i]] = same ? representative[order[i - 1]] : order[i];
  }
  return representative;
}

struct Edge {
  Index low, high;  // welded vertices
  Index triangle;
  int direction;  // +1 from low to high
};

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index(0));
  }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller number leads, so that the result does not depend on the order.
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

double signed_volume(const Mesh& mesh, std::size_t first, std::size_t count) {
  if (count == 0) return 0;
  const Vec3 origin = mesh.position(mesh.triangles[first].a);
  double sum = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const Mesh::Triangle& t = mesh.triangles[i];
    sum += dot(mesh.position(t.a) - origin,
               cross(mesh.position(t.b) - origin, mesh.position(t.c) - origin));
  }
  return sum / 6;
}

void find_solids(Mesh* mesh) {
  const std::vector<Index> welded = weld(*mesh);
  std::erase_if(mesh->triangles, [&](const Mesh::Triangle& t) {
    return welded[t.a] == welded[t.b] || welded[t.b] == welded[t.c] || welded[t.c] == welded[t.a];
  });
  std::vector<Edge> edges;
  edges.reserve(3 * mesh->triangles.size());
  for (Index i = 0; i < mesh->triangles.size(); ++i) {
    const Mesh::Triangle& t = mesh->triangles[i];
    for (auto [from, to] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
      const Index f = welded[from], g = welded[to];
      edges.push_back({std::min(f, g), std::max(f, g), i, f < g ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  Groups groups(mesh->triangles.size());
  std::vector<std::uint8_t> open(mesh->triangles.size());
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    std::size_t end = i;
    for (; end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high;
         ++end) {
      balance += edges[end].direction;
      groups.join(edges[i].triangle, edges[end].triangle);
    }
    if (balance != 0) open[edges[i].triangle] = 1;
    i = end;
  }
  // Triangles in the order of their components, sheets last.
  std::vector<Index> order(mesh->triangles.size());
  std::iota(order.begin(), order.end(), Index(0));
  for (Index i : order) {
    if (open[i]) open[groups.find(i)] = 1;
  }
  std::vector<Index> leader(order.size());
  for (Index i : order) leader[i] = groups.find(i);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    const bool open_a = open[leader[a]] != 0, open_b = open[leader[b]] != 0;
    return open_a != open_b ? open_b : !open_a && leader[a] < leader[b];
  });
  std::vector<Mesh::Triangle> sorted, flat;
  sorted.reserve(order.size());
  for (Index i : order) sorted.push_back(mesh->triangles[i]);
  mesh->triangles.clear();
  mesh->parts.clear();
  std::vector<Mesh::Triangle>& kept = mesh->triangles;
  for (std::size_t i = 0; i < order.size();) {
    const Index group = leader[order[i]];
    if (open[group]) break;
    const std::size_t first = kept.size();
    Bounds bounds;
    for (; i < order.size() && leader[order[i]] == group; ++i) {
      kept.push_back(sorted[i]);
      bounds.add(mesh->position(sorted[i].a));
    }
    const double volume = signed_volume(*mesh, first, kept.size() - first);
    const double cube = std::pow(bounds.longest_side(), 3);
    if (!(volume > 1e-9 * cube)) {
      flat.insert(flat.end(), kept.begin() + std::ptrdiff_t(first), kept.end());
      kept.resize(first);
      continue;
    }
    mesh->parts.push_back({first, kept.size() - first, true});
  }
  const std::size_t first = kept.size();
  const auto sheets =
      std::count_if(leader.begin(), leader.end(), [&](Index l) { return open[l] != 0; });
  kept.insert(kept.end(), flat.begin(), flat.end());
  kept.insert(kept.end(), sorted.end() - sheets, sorted.end());
  if (kept.size() > first) mesh->parts.push_back({first, kept.size() - first, false});
}

}  // namespace obscura::tools
