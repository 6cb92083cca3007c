"""Ambient visibility of depth images."""
import sys

import numpy as np

from . import _library
from ._camera import Camera
from ._settings import _METHODS, as_text, table

_VECTORS = ("bent_normal", "uniform_integral", "cosine_integral", "normal")


def _array(name, value):
    """Arrays as they are; what can show itself as one, without a copy."""
    if value is None or isinstance(value, np.ndarray):
        return value
    if hasattr(value, "dims") and hasattr(value, "values"):  # xarray
        return value.values
    if hasattr(value, "array") and hasattr(value, "spacing"):  # obscura.Volume
        return value.array
    if hasattr(value, "__dlpack__"):
        return np.from_dlpack(value)
    if hasattr(value, "__array_interface__"):
        return np.asarray(value)
    raise TypeError(f"{name} is a {type(value).__name__}; it must be a float32 array")


def _guard(guard_band):
    """(left, right, top, bottom) from a number, (x, y) or all four."""
    g = (guard_band,) * 4 if isinstance(guard_band, int) else tuple(guard_band)
    if len(g) == 2:
        g = (g[0], g[0], g[1], g[1])
    if len(g) != 4 or any(not isinstance(v, (int, np.integer)) or v < 0 for v in g):
        raise ValueError(f"guard_band is {guard_band}; it must be a count of pixels, (x, y), or "
                         "(left, right, top, bottom)")
    return [int(v) for v in g]


def _field(depth, camera, guard_band, depth_kind, near, far, normals, back_depth, layers):
    if not isinstance(camera, Camera):
        raise TypeError(f"camera is a {type(camera).__name__}; it must be an obscura.Camera")
    if depth is None:
        raise TypeError("depth is None; it must be a float32 array of shape (H, W)")
    depth = _array("depth", depth)
    guard = _guard(guard_band)
    shape = np.shape(depth)
    width = (shape[1] if len(shape) == 2 else 1) - guard[0] - guard[1]
    height = (shape[0] if shape else 1) - guard[2] - guard[3]
    none = isinstance(normals, str)
    if none and normals != "none":
        raise ValueError(f"normals is '{normals}'; it must be an array, None (from depth) or 'none'")
    arrays = [depth, None if none else _array("normals", normals), _array("back_depth", back_depth)]
    pairs = [[_array("a layer's front", f), _array("a layer's back", b)] for f, b in layers or []]
    camera_numbers = camera._resolve(max(width, 1), max(height, 1), guard)
    field = _library.Field(arrays[0], camera_numbers, guard, depth_kind, near, far, arrays[1], none,
                           arrays[2], pairs)
    return field, (arrays, pairs), (height, width)


def _results(outputs, out, size):
    names = (outputs,) if isinstance(outputs, str) else tuple(outputs)
    if not names:
        raise ValueError("outputs is empty; name one, such as 'visibility'")
    given = {names[0]: out} if out is not None and not isinstance(out, dict) else dict(out or {})
    arrays = []
    for name in names:
        array = given.pop(name, None)
        if array is None:
            array = np.empty(size + ((3,) if name in _VECTORS else ()), np.float32)
        elif not isinstance(array, np.ndarray):
            raise TypeError(f"out is a {type(array).__name__}; it must be a float32 array")
        arrays.append((name, array))
    if given:
        raise ValueError(f"out has '{next(iter(given))}', which is not among outputs")
    return arrays


def _bar(share):
    print(f"\robscura {100 * share:3.0f} %", end="" if share < 1 else "\n", file=sys.stderr, flush=True)


def _progress(progress):
    if progress is None or progress is False:
        return None
    if progress is True:
        return _bar if sys.stderr.isatty() or "ipykernel" in sys.modules else None
    return progress


def _like_image(image, array):
    """A DataArray with the coordinates of `image`, where that is one."""
    if not (hasattr(image, "dims") and hasattr(image, "isel")):
        return array
    if array.ndim == 2:
        return image.copy(data=array)
    return type(image)(array, dims=image.dims + ("component",), coords=image.coords)


def _wrap(depth, guard_band, array):
    """Results of a DataArray are DataArrays with the coordinates of its visible part."""
    if not (hasattr(depth, "dims") and hasattr(depth, "isel")):
        return array
    left, right, top, bottom = _guard(guard_band)
    y, x = depth.dims
    return _like_image(depth.isel({y: slice(top, depth.sizes[y] - bottom),
                                   x: slice(left, depth.sizes[x] - right)}), array)


def visibility(depth, *, camera, method="far-field", outputs=("visibility",), normals=None,
               guard_band=0, back_depth=None, layers=None, depth_kind="linear", near=0.0,
               far=float("inf"), out=None, threads=0, progress=None, **settings):
    texts = as_text(method, settings)
    field, keep, size = _field(depth, camera, guard_band, depth_kind, near, far, normals, back_depth,
                               layers)
    arrays = _results(outputs, out, size)
    _library.compute(field, method, texts, arrays, threads, _progress(progress))
    del keep
    wrapped = {name: _wrap(depth, guard_band, array) for name, array in arrays}
    return wrapped if len(wrapped) > 1 else next(iter(wrapped.values()))


class Estimator:
    """A method with fixed settings and image size, for many frames.

    Tables, patterns and memory are made once; later frames of the library allocate nothing.
    """

    def __init__(self, method="far-field", *, shape, **settings):
        """`shape` is that of the depth images, (H, W), guard band included."""
        height, width = (int(n) for n in shape)
        self._frames = _library.Frames(method, as_text(method, settings), width, height)

    def run(self, depth, *, camera, outputs=("visibility",), normals=None, guard_band=0,
            back_depth=None, layers=None, depth_kind="linear", near=0.0, far=float("inf"), out=None,
            threads=0, progress=None):
        """As obscura.visibility, for one frame."""
        field, keep, size = _field(depth, camera, guard_band, depth_kind, near, far, normals,
                                   back_depth, layers)
        arrays = _results(outputs, out, size)
        self._frames.run(field, arrays, threads, _progress(progress))
        del keep
        wrapped = {name: _wrap(depth, guard_band, array) for name, array in arrays}
        return wrapped if len(wrapped) > 1 else next(iter(wrapped.values()))


visibility.__doc__ = """Ambient visibility of a depth image.

    depth: float32 array (H, W), row 0 on top, positive; +inf, NaN and 1e9 and beyond are background.
        Any strides are taken, without a copy. An xarray DataArray comes back as one.
    camera: obscura.Camera of the visible part.
    method: one of obscura.methods(); its settings go by keyword.
    outputs: names of results: visibility (H, W) in [0, 1], 1 is open; bent_normal (H, W, 3), unit
        vectors in eye space; cone_angle (H, W) in radians; uniform_integral, cosine_integral,
        normal (H, W, 3); standard_error (H, W) of the tracer.
    normals: float32 array (H, W, 3) in eye space; None: from depth; "none": without.
    guard_band: pixels around the visible part: a number, (x, y) or (left, right, top, bottom).
    back_depth, layers: where the first surface's matter ends; [(front, back), ...], nearest first.
    depth_kind: linear, distance, ndc or ndc-reversed, with near and far planes.
    out: an array to write to, or a dict of them by the names of outputs.
    threads: 0 for every processor.
    progress: a callable of the share done, or True for a line on the terminal.

    Returns the result, or a dict where several outputs are asked for. Raises ValueError, TypeError,
    MemoryError with a sentence that says what would be right. The interpreter's lock is free while
    it computes; Ctrl-C stops it.

Methods and their settings:

""" + "\n".join(f"{name}: {summary}\n{table(name)}" for name, (summary, _, _) in _METHODS.items())
