"""Sky-view factor, openness and horizons of elevation models."""
import numpy as np

from . import _library
from ._screen import _array, _progress
from ._settings import as_text, settings as settings_of, table


def _cell_size(heights, cell_size):
    """(width, height) of a cell: as given, or from the coordinates of a DataArray."""
    if cell_size is not None:
        pair = (cell_size, cell_size) if np.isscalar(cell_size) else tuple(cell_size)
        if len(pair) != 2:
            raise ValueError(f"cell_size is {cell_size}; it must be a number or (width, height)")
        return float(pair[0]), float(pair[1])
    if not hasattr(heights, "coords"):
        raise TypeError("cell_size is missing: the side of a cell, in the unit of the heights")
    steps = []
    for dim in (heights.dims[1], heights.dims[0]):
        if dim not in heights.coords or heights.sizes[dim] < 2:
            raise TypeError(f"cell_size is missing, and heights have no coordinate '{dim}' to take it from")
        step = np.diff(np.asarray(heights.coords[dim], dtype=np.float64))
        if not np.allclose(step, step[0], rtol=1e-3):
            raise ValueError(f"coordinate '{dim}' has no constant step; give cell_size")
        steps.append(step[0])
    if steps[1] > 0:
        raise ValueError("row 0 must be the northern edge; the second coordinate rises with the rows: "
                         "turn the array, heights[::-1]")
    return abs(steps[0]), abs(steps[1])


def terrain(heights, *, cell_size=None, quantities=("svf",), nodata=None, datum=None, threads=0,
            progress=None, **settings):
    return _terrain(heights, cell_size, quantities, nodata, datum, None, threads, progress, settings)


def _terrain(heights, cell_size, quantities, nodata, datum, tile, threads, progress, settings):
    """Of a part of a larger model: `tile` is that model's width and height, column and row of the
    heights in it, and x, y, width, height of what is wanted of them."""
    texts = as_text("terrain", settings)
    names = (quantities,) if isinstance(quantities, str) else tuple(quantities)
    if not names:
        raise ValueError("quantities is empty; name one, such as 'svf'")
    width, height = _cell_size(heights, cell_size)
    model = _array("heights", heights)
    shape = np.shape(model) if tile is None else (tile[7], tile[6])
    arrays = []
    for name in names:
        azimuths = int(settings.get("azimuths", settings_of("terrain")["azimuths"][2]))
        size = (max(azimuths, 1),) + shape if name == "horizon" else shape
        arrays.append((name, np.empty(size, np.float32)))
    _library.terrain(model, width, height, None if nodata is None else float(nodata), texts, arrays,
                     None if datum is None else float(datum), tile, threads, _progress(progress))
    results = {}
    for name, array in arrays:
        labelled = hasattr(heights, "dims") and hasattr(heights, "copy") and array.ndim == 2
        results[name] = heights.copy(data=array) if labelled else array
    return results if len(results) > 1 else next(iter(results.values()))


terrain.__doc__ = """Sky-view factor, openness and horizons of an elevation model.

    heights: float32 array (H, W), row 0 is the northern edge; NaN, infinite values and `nodata` have
        no data, and become NaN. An xarray DataArray comes back as one.
    cell_size: side of a cell, or (width, height), in the unit of the heights (see z_factor); taken
        from the coordinates of a DataArray where it is not given.
    quantities: svf, svf_normal, svf_cosine in [0, 1]; openness, negative_openness in degrees;
        visible_sky in per cent; asvf; local_dominance; horizon, (azimuths, H, W) in degrees,
        clockwise from north. docs/terrain.md has the formulas.
    datum: taken from the heights before they are rounded; None: the first height.
    threads: 0 for every processor. progress: a callable of the share done, or True.

    Returns the result, or a dict where several quantities are asked for.

Settings:

""" + table("terrain") + "\n"
