"""obscura.terrain: figures on paper."""
import math

import numpy as np
import pytest

import obscura


def plane(slope_deg, n=160):
    y = np.arange(n, dtype=np.float32)[:, None] * math.tan(math.radians(slope_deg))
    return np.ascontiguousarray(np.broadcast_to(y, (n, n))).astype(np.float32)


def test_flat_ground_is_open():
    r = obscura.terrain(np.zeros((40, 50), np.float32), cell_size=1,
                        quantities=("svf", "openness", "visible_sky", "horizon"))
    assert (r["svf"] == 1).all() and (r["openness"] == 90).all() and (r["visible_sky"] == 100).all()
    assert r["horizon"].shape == (16, 40, 50) and (r["horizon"] == 0).all()


def test_a_plane_has_the_figures_of_the_literature():
    r = obscura.terrain(plane(30), cell_size=1, azimuths=64,
                        quantities=("svf", "svf_normal", "openness"))
    middle = (slice(70, 90), slice(70, 90))
    assert abs(r["svf"][middle].mean() - 0.8333) < 0.012
    assert abs(r["svf_normal"][middle].mean() - 0.9330) < 0.012
    assert abs(r["openness"][middle].mean() - 90) < 1.2


def test_cells_without_data():
    heights = plane(10)
    heights[5, 5] = -9999
    heights[6, 6] = np.nan
    v = obscura.terrain(heights, cell_size=1, nodata=-9999)
    assert np.isnan(v[5, 5]) and np.isnan(v[6, 6]) and np.isnan(v).sum() == 2


def test_the_size_of_cells_counts():
    low = obscura.terrain(plane(30), cell_size=10).mean()
    assert low > obscura.terrain(plane(30), cell_size=1).mean() + 0.05


@pytest.mark.parametrize("keywords, error, words", [
    ({}, TypeError, "cell_size is missing"),
    ({"cell_size": 0}, ValueError, "cell"),
    ({"cell_size": 1, "azimuths": 0}, ValueError, "azimuths"),
    ({"cell_size": 1, "azimuth": 8}, TypeError, "no setting 'azimuth'; it has azimuths"),
    ({"cell_size": 1, "quantities": "svv"}, ValueError, "no quantity 'svv'; there are"),
    ({"cell_size": 1, "quantities": ()}, ValueError, "quantities is empty"),
])
def test_mistakes_are_named(keywords, error, words):
    with pytest.raises(error, match=words):
        obscura.terrain(plane(10), **keywords)


def test_other_types_are_refused():
    with pytest.raises(TypeError, match="heights is int16; it must be float32"):
        obscura.terrain(plane(10).astype(np.int16), cell_size=1)


def test_data_arrays_bring_the_size_of_their_cells():
    xarray = pytest.importorskip("xarray")
    h = plane(30)
    y, x = 1000 - 10.0 * np.arange(160), 10.0 * np.arange(160)
    d = xarray.DataArray(h, dims=("y", "x"), coords={"y": y, "x": x})
    v = obscura.terrain(d)
    assert v.dims == ("y", "x") and (v.values == obscura.terrain(h, cell_size=10)).all()
    with pytest.raises(ValueError, match="northern"):
        obscura.terrain(d.isel(y=slice(None, None, -1)))
