"""Volumes: axes, distances on paper, light of octants, arrays of every kind."""
import numpy as np
import pytest

import obscura

SHAPE = (20, 24, 30)
CENTRE = (6, 9, 17)  # z, y, x: near none of the volume's planes of symmetry


def ball(radius=5.0, spacing=(1, 1, 1)):
    z, y, x = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in SHAPE), indexing="ij")
    d = np.sqrt(sum((s * (a - c)) ** 2 for s, a, c in zip(spacing, (z, y, x), CENTRE)))
    return (radius - d).astype(np.float32)


@pytest.mark.parametrize("spacing", [(1, 1, 1), (1.5, 1.0, 0.75)])
def test_a_ball_stays_where_it_is(spacing):
    d = obscura.sweep_distance(ball(4.3, spacing), isovalue=0, spacing=spacing)
    assert d.shape == SHAPE and d.dtype == np.float32
    assert np.unravel_index(d.argmin(), SHAPE) == CENTRE
    right = -ball(4.3, spacing)
    # First-order sweeps end a few per cent too far; mirrored, the whole ball is elsewhere.
    assert (np.abs(d - right) < 1 + 0.06 * np.abs(right)).all()
    for axis in range(3):
        assert (np.abs(np.flip(d, axis) - right) > 1 + 0.06 * np.abs(right)).any()


def test_a_ramp_along_each_axis():
    for axis, step in enumerate((4.0, 3.0, 2.0)):
        shape = [1, 1, 1]
        shape[axis] = SHAPE[axis]
        ramp = np.arange(SHAPE[axis], dtype=np.float32).reshape(shape)
        d = obscura.sweep_distance(np.broadcast_to(ramp, SHAPE), isovalue=10, spacing=(4, 3, 2))
        assert np.allclose(d, np.broadcast_to((10 - ramp) * step, SHAPE), atol=1e-3)


@pytest.mark.parametrize("solid, factor", [("above", 1), ("below", -1)])
def test_the_other_side(solid, factor):
    d = obscura.sweep_distance(ball(), isovalue=0, solid=solid)
    assert np.sign(d[CENTRE]) == -factor and np.sign(d[0, 0, 0]) == factor


def test_other_layouts_are_read_in_place():
    v = ball()
    right = obscura.sweep_distance(v, isovalue=0)
    xyz = np.asfortranarray(v.T)  # as nibabel holds it
    assert xyz.T.shape == SHAPE
    large = np.zeros((40, 24, 60), np.float32)
    large[::2, :, ::2] = v
    for same in (np.asfortranarray(v), xyz.T, large[::2, :, ::2], v[::-1].copy()[::-1]):
        same.flags.writeable = False
        assert (obscura.sweep_distance(same, isovalue=0) == right).all()
    out = np.empty(SHAPE, np.float32, order="F")
    assert obscura.sweep_distance(v, isovalue=0, out=out) is out and (out == right).all()


@pytest.mark.parametrize("dtype", [np.uint8, np.int16, np.uint16])
def test_integers_and_their_scale(dtype):
    v = np.round(np.clip(ball() * 4 + 100, 0, 250)).astype(dtype)
    as_float = obscura.sweep_distance(v.astype(np.float32), isovalue=100)
    assert (obscura.sweep_distance(v, isovalue=100) == as_float).all()
    scaled = obscura.sweep_distance(v, isovalue=0, slope=0.25, intercept=-25)
    assert np.allclose(scaled, as_float, atol=1e-4)


def test_octants_are_of_the_axes():
    for axis, bit in ((2, 0), (1, 1), (0, 2)):  # x, y, z
        wall = np.full(SHAPE, -1, np.float32)
        far = [slice(None)] * 3
        far[axis] = slice(SHAPE[axis] - 6, None)
        wall[tuple(far)] = 1
        field = obscura.sweep_occlusion(obscura.sweep_distance(wall, isovalue=0))
        at = tuple(n // 2 for n in field.shape)
        for number in range(8):
            if number >> bit & 1:
                away = field.octant(number ^ 1 << bit)[at]
                assert away > 0.95 and field.octant(number)[at] < away - 0.3, (axis, number)
        assert 0.5 < field.mean()[at] < 0.9


def test_an_open_plane_is_lit_and_its_other_side_is_not():
    floor = np.full((32, 32, 32), -1, np.float32)
    floor[:8] = 1  # z below
    field = obscura.sweep_occlusion(obscura.sweep_distance(floor, isovalue=0))
    at = np.array([[16, 16, 7.6]], np.float32)  # x, y, z
    up = np.array([[0, 0, 1]], np.float32)
    assert field.light(at, up)[0] > 0.95
    assert field.light(at, up, octants=[4, 5, 6, 7])[0] > 0.95  # light from +z
    assert field.light(at, up, octants=[0, 1, 2, 3])[0] < 0.05


def test_the_shadow_falls_away_from_the_light():
    d = obscura.sweep_distance(ball(), isovalue=0)
    field = obscura.sweep_shadow(d, (1, 0, 0))
    z, y, x = CENTRE
    points = np.array([[x - 8, y, z], [x + 8, y, z]], np.float32)
    dark, bright = field.light(points, np.array([[1, 0, 0]] * 2, np.float32))
    assert dark < 0.3 and bright > 0.9


def test_threads_change_nothing():
    v = ball()
    one, two = (obscura.sweep_distance(v, isovalue=0, threads=n) for n in (1, 2))
    assert (one == two).all()
    a, b = (obscura.sweep_occlusion(one, threads=n).mean() for n in (1, 2))
    assert (a == b).all()


def test_data_arrays():
    xarray = pytest.importorskip("xarray")
    v = xarray.DataArray(ball(spacing=(2, 1, 0.5)), dims=("z", "y", "x"),
                         coords={"z": 2.0 * np.arange(20), "y": np.arange(24.0),
                                 "x": 0.5 * np.arange(30)})
    d = obscura.sweep_distance(v, isovalue=0)
    assert d.dims == v.dims and (d.x == v.x).all()
    assert (d.values == obscura.sweep_distance(v.values, isovalue=0, spacing=(2, 1, 0.5))).all()


@pytest.mark.parametrize("make, error, words", [
    (lambda: obscura.sweep_distance(ball().astype(np.float64), isovalue=0), TypeError,
     "volume is float64; it must be uint8, int16, uint16 or float32"),
    (lambda: obscura.sweep_distance(ball().astype(">f4"), isovalue=0), TypeError, "volume is >f4"),
    (lambda: obscura.sweep_distance(ball()[0], isovalue=0), ValueError, r"shape \(24, 30\)"),
    (lambda: obscura.sweep_distance(ball()[:0], isovalue=0), ValueError, "0"),
    (lambda: obscura.sweep_distance(ball(), isovalue=99), ValueError, "isovalue"),
    (lambda: obscura.sweep_distance(ball(), isovalue=0, spacing=(1, 2)), ValueError, "spacing"),
    (lambda: obscura.sweep_distance(ball(), isovalue=0, spacing=0), ValueError, "spacing"),
    (lambda: obscura.sweep_distance(ball(), isovalue=0, sweps=8), TypeError, "no setting 'sweps'"),
    (lambda: obscura.sweep_distance(ball(), isovalue=0, out=np.empty((2, 2, 2), np.float32)),
     ValueError, r"out has shape \(2, 2, 2\)"),
    (lambda: obscura.sweep_distance(np.ma.masked_less(ball(), 0), isovalue=0), TypeError, "masked"),
    (lambda: obscura.sweep_distance([[[1.0]]], isovalue=0), TypeError, "volume is a list"),
    (lambda: obscura.sweep_occlusion(ball(), transport="fastest"), ValueError, "transport"),
    (lambda: obscura.sweep_shadow(ball(), (0, 0, 0)), ValueError, "to_light"),
    (lambda: obscura.sweep_occlusion(-ball()).light(np.zeros((2, 3), np.float32),
                                                    np.zeros((1, 3), np.float32)), ValueError,
     "normals has shape"),
    (lambda: obscura.sweep_occlusion(-ball()).octant(8), ValueError, "octant"),
])
def test_mistakes_are_named(make, error, words):
    with pytest.raises(error, match=words):
        make()
