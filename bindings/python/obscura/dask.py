"""Elevation models and stacks of frames in chunks, by Dask.

    import obscura.dask
    svf = obscura.dask.terrain(model, cell_size=10, radius=2000).compute()

Results are Dask arrays: nothing runs before they are computed, on any of Dask's schedulers.
"""
import math

import dask
import dask.array
import numpy as np

from ._screen import visibility as _visibility
from ._settings import settings as _settings_of
from ._terrain import _cell_size, _terrain

__all__ = ["terrain", "visibility"]


def _steps(chunks):
    """(first, end) of each chunk along an axis."""
    ends = np.cumsum(chunks).tolist()
    return list(zip([0] + ends[:-1], ends))


def terrain(heights, *, cell_size, radius, quantities=("svf",), nodata=None, datum=0.0, **settings):
    """obscura.terrain of a chunked model, a task for each chunk.

    heights: Dask array (H, W) of float32. Each task reads its chunk and a halo as wide as the radius.
    radius: how far away ground may hide the sky, finite, in the unit of cell_size.
    datum: as for obscura.terrain: with the same one the results have the same bits.

    Returns a Dask array with the chunks of `heights`, or a dict where several quantities are asked
    for. The quantity "horizon" is (azimuths, H, W). Other keywords are those of obscura.terrain.
    """
    if not 0 < radius < math.inf:
        raise ValueError(f"radius is {radius}; it must be in (0, inf): the halo of a chunk is as wide. "
                         "`obscura terrain --tile` knows tiles without a radius")
    if heights.ndim != 2 or heights.dtype != np.float32:
        raise TypeError(f"heights are {heights.dtype} of shape {heights.shape}; they must be a Dask "
                        "array of float32, (H, W)")
    names = (quantities,) if isinstance(quantities, str) else tuple(quantities)
    width, height = _cell_size(heights, cell_size)
    across, down = (math.ceil(radius / side) + 1 for side in (width, height))
    rows, columns = heights.shape
    task = dask.delayed(_tile, pure=True)
    blocks = {name: [] for name in names}
    for y0, y1 in _steps(heights.chunks[0]):
        line = {name: [] for name in names}
        for x0, x1 in _steps(heights.chunks[1]):
            left, top = max(0, x0 - across), max(0, y0 - down)
            part = heights[top:y1 + down, left:x1 + across]
            tile = (columns, rows, left, top, x0 - left, y0 - top, x1 - x0, y1 - y0)
            # One chunk, so that a task gets an array.
            found = task(dask.delayed(_joined)(part.to_delayed().tolist()), (width, height), names,
                         nodata, datum, tile, {"radius": radius, **settings})
            for name in names:
                shape = (y1 - y0, x1 - x0)
                if name == "horizon":
                    shape = (int(settings.get("azimuths", _settings_of("terrain")["azimuths"][2])),
                             ) + shape
                line[name].append(dask.array.from_delayed(found[name], shape, np.float32))
        for name in names:
            blocks[name].append(line[name])
    results = {name: dask.array.concatenate(
        [dask.array.concatenate(line, axis=-1) for line in lines], axis=-2)
        for name, lines in blocks.items()}
    return results if len(results) > 1 else results[names[0]]


def _joined(parts):
    return np.ascontiguousarray(np.block(parts))


def _tile(heights, cell_size, names, nodata, datum, tile, settings):
    found = _terrain(heights, cell_size, names, nodata, datum, tile, 1, None, settings)
    return found if len(names) > 1 else {names[0]: found}


def visibility(frames, *, camera, guard_band=0, **keywords):
    """obscura.visibility of a stack of frames, a task for each chunk of frames.

    frames: Dask array (N, H, W) of float32, in chunks of whole frames: `frames.rechunk((1, -1, -1))`.
    Returns a Dask array (N, H, W) of the visible parts. Other keywords are those of
    obscura.visibility, with one output.
    """
    if frames.ndim != 3 or frames.dtype != np.float32:
        raise TypeError(f"frames are {frames.dtype} of shape {frames.shape}; they must be a Dask array "
                        "of float32, (N, H, W)")
    if len(frames.chunks[1]) > 1 or len(frames.chunks[2]) > 1:
        raise ValueError(f"frames are cut into chunks of {frames.chunksize}; frames must be whole: "
                         "frames.rechunk((1, -1, -1))")

    def of_chunk(chunk):
        return np.stack([_visibility(frame, camera=camera, guard_band=guard_band, threads=1,
                                     **keywords) for frame in chunk])

    one = _visibility(np.ones(frames.shape[1:], np.float32), camera=camera, guard_band=guard_band,
                      **keywords)
    if not isinstance(one, np.ndarray) or one.ndim != 2:
        raise ValueError("outputs must be one image, such as 'visibility'")
    return frames.map_blocks(of_chunk, dtype=np.float32, meta=np.empty((0, 0, 0), np.float32),
                             chunks=(frames.chunks[0], (one.shape[0],), (one.shape[1],)))
