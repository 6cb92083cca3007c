#ifndef OBSCURA_SRC_LIGHTING_CUBE_GRID_H_
#define OBSCURA_SRC_LIGHTING_CUBE_GRID_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace obscura::lighting {

// Functions of direction on a cube whose samples lie on the vertices of a grid on each face, the
// face's edges included. Neighbouring faces hold the same samples along their common edge, so that
// bilinear interpolation within a face is continuous over the whole sphere: no seams, no borders.
//
// Face 2k looks along axis k, face 2k + 1 against it; its first coordinate runs along axis k + 1
// and its second along axis k + 2 (modulo 3), both in the axis' own sense.
struct CubeGrid {
  int cells;  // along a face's side

  int side() const { return cells + 1; }
  std::size_t vertices() const { return std::size_t{6} * side() * side(); }
  std::size_t index(int face, int i, int j) const {
    return (std::size_t(face) * side() + j) * side() + i;
  }

  struct Vertex {
    int face, i, j;
  };
  // The face that owns a vertex: the first of those that share it.
  Vertex owner(Vertex v) const {
    const std::array<int, 3> p = lattice(v);
    for (int face = 0; face < v.face; ++face) {
      const int axis = face / 2;
      if (p[axis] == (face % 2 == 0 ? cells : 0)) {
        return {face, p[(axis + 1) % 3], p[(axis + 2) % 3]};
      }
    }
    return v;
  }

  // Unit; the same bits from each face that shares the vertex.
  std::array<float, 3> direction(Vertex v) const {
    const std::array<int, 3> p = lattice(v);
    std::array<double, 3> d;
    for (int k = 0; k < 3; ++k) d[k] = static_cast<double>(2 * p[k] - cells) / cells;
    const double scale = 1 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return {float(d[0] * scale), float(d[1] * scale), float(d[2] * scale)};
  }

  // The cell that a direction hits and where in it, in [0, 1].
  struct Hit {
    std::size_t index;  // of the cell's first vertex; the others: + 1, + side(), + side() + 1
    float u, v;
  };
  Hit hit(const std::array<float, 3>& d) const {
    const float ax = std::abs(d[0]), ay = std::abs(d[1]), az = std::abs(d[2]);
    const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    const int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
    const float scale = 0.5f / std::abs(d[axis]);
    auto cell = [&](int k, float* fraction) {
      const float at = (d[k % 3] * scale + 0.5f) * static_cast<float>(cells);
      const int i = std::clamp(static_cast<int>(at), 0, cells - 1);
      *fraction = std::clamp(at - static_cast<float>(i), 0.0f, 1.0f);
      return i;
    };
    Hit h{};
    const int i = cell(axis + 1, &h.u), j = cell(axis + 2, &h.v);
    h.index = index(face, i, j);
    return h;
  }

  template <class Visit>  // visit(Vertex) for every vertex of every face
  void for_each(Visit&& visit) const {
    for (int face = 0; face < 6; ++face) {
      for (int j = 0; j < side(); ++j) {
        for (int i = 0; i < side(); ++i) visit(Vertex{face, i, j});
      }
    }
  }
  bool owns(Vertex v) const { return owner(v).face == v.face; }

 private:
  std::array<int, 3> lattice(Vertex v) const {
    const int axis = v.face / 2;
    std::array<int, 3> p{};
    p[axis] = v.face % 2 == 0 ? cells : 0;
    p[(axis + 1) % 3] = v.i;
    p[(axis + 2) % 3] = v.j;
    return p;
  }
};

}  // namespace obscura::lighting

#endif  // OBSCURA_SRC_LIGHTING_CUBE_GRID_H_
