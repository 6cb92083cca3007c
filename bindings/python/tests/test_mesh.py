"""obscura.mesh_visibility: figures on paper."""
import math

import numpy as np
import pytest

import obscura

pytest.importorskip("obscura._files")
FAR = dict(falloff="constant", radius=math.inf)


def box():
    """A cube of side 2 around the origin, faces outward."""
    v = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    f = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return v, np.array(f, np.uint32)


def quad(*corners):
    return np.array(corners, np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.uint32)


def test_a_cube_is_open_outside_and_closed_inside():
    v, f = box()
    assert (obscura.mesh_visibility(v, f, rays=64, **FAR) == 1).all()
    inside = np.zeros((1, 3), np.float32)
    assert obscura.mesh_visibility(v, f, inside, inside + np.float32([0, 1, 0]), **FAR)[0] == 0


def test_an_endless_wall_hides_half_the_sky():
    e = 1e4
    wall = quad([1, 0, -e], [1, e, -e], [1, e, e], [1, 0, e])
    at, up = np.zeros((1, 3), np.float32), np.array([[0, 2, 0]], np.float32)
    seen, bent = obscura.mesh_visibility(*wall, at, up, rays=4096, bent_normals=True, **FAR)
    assert abs(seen[0] - 0.5) < 0.01
    # The open quarter of the sphere: its middle direction.
    assert np.allclose(bent[0], [-math.sqrt(0.5), math.sqrt(0.5), 0], atol=0.02)


def test_a_disc_overhead():
    # A disc of half-angle a above: visibility is cos^2 a.
    t = np.linspace(0, 2 * math.pi, 257)[:-1]
    v = np.stack([np.cos(t), np.ones_like(t), np.sin(t)], 1).astype(np.float32)
    v = np.concatenate([[[0, 1, 0]], v]).astype(np.float32)
    f = np.array([[0, 1 + i, 1 + (i + 1) % 256] for i in range(256)], np.uint32)
    at, up = np.zeros((1, 3), np.float32), np.array([[0, 1, 0]], np.float32)
    assert abs(obscura.mesh_visibility(v, f, at, up, rays=4096, **FAR)[0] - 0.5) < 0.01
    near = obscura.mesh_visibility(v, f, at, up, rays=64, falloff="constant", radius=0.9)
    assert near[0] == 1  # the disc is farther away


def test_threads_change_nothing_and_files_go_in(tmp_path):
    with open(tmp_path / "q.obj", "w", encoding="ascii") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n")
    mesh = obscura.read(tmp_path / "q.obj")
    one, two = (obscura.mesh_visibility(mesh.vertices, mesh.faces, threads=n, rays=100)
                for n in (1, 2))
    assert one.shape == (4,) and (one == two).all() and one.min() < 1


@pytest.mark.parametrize("change, error, words", [
    ({"faces": np.array([[0, 1, 9]], np.uint32)}, ValueError, "names vertex 9; there are 8"),
    ({"faces": np.array([[0, 1, 2]], np.int64)}, TypeError, "faces is int64; it must be uint32"),
    ({"faces": np.zeros((0, 3), np.uint32)}, ValueError, "faces is empty"),
    ({"vertices": np.full((8, 3), np.nan, np.float32)}, ValueError, "vertex 0 is not finite"),
    ({"vertices": np.zeros((8, 2), np.float32)}, ValueError, r"vertices has shape \(8, 2\)"),
    ({"points": np.zeros((1, 3), np.float32)}, TypeError, "go together"),
    ({"points": np.zeros((1, 3), np.float32), "normals": np.zeros((1, 3), np.float32)}, ValueError,
     "normal 0 is 0,0,0"),
    ({"points": np.zeros((1, 3), np.float32), "normals": np.ones((2, 3), np.float32)}, ValueError,
     "1 points and 2 normals"),
    ({"rays": 0}, ValueError, "rays"),
])
def test_mistakes_are_named(change, error, words):
    v, f = box()
    with pytest.raises(error, match=words):
        obscura.mesh_visibility(**{"vertices": v, "faces": f, **change})
