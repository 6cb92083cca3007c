"""Distances and ambient visibility in volumes."""
import numpy as np

from . import _library
from ._screen import _array, _progress
from ._settings import as_text, table


class Volume:
    """A volume of a file.

    array: its samples, (Z, Y, X); a voxel's value is slope * sample + intercept. spacing: (z, y, x).
    isovalue, solid: what the file itself says of its surface, or None. notes: what was chosen on
    reading, a line each. Goes in wherever an array does.
    """

    def __init__(self, array, spacing=(1.0, 1.0, 1.0), slope=1.0, intercept=0.0):
        self.array, self.spacing = array, tuple(spacing)
        self.slope, self.intercept = slope, intercept
        self.isovalue = self.solid = self._loaded = None
        self.notes = []

    @classmethod
    def _of_file(cls, tools, loaded):
        v = cls(tools.Loaded.samples(loaded), loaded.spacing(), *loaded.scale())
        v.isovalue, v.solid, v.notes, v._loaded = (loaded.isovalue(), loaded.solid(),
                                                   loaded.notes(), loaded)
        return v


def _spacing(volume, spacing):
    """(z, y, x) steps of the array: as given, or from the coordinates of a DataArray."""
    if spacing is not None:
        steps = (spacing,) * 3 if np.isscalar(spacing) else tuple(spacing)
        if len(steps) != 3:
            raise ValueError(f"spacing is {spacing}; it must be a number or three, in the order of "
                             "the axes: (z, y, x)")
        return [float(s) for s in steps]
    if isinstance(volume, Volume):
        return [float(s) for s in volume.spacing]
    if not hasattr(volume, "coords"):
        return [1.0, 1.0, 1.0]
    steps = []
    for dim in volume.dims:
        if dim not in volume.coords or volume.sizes[dim] < 2:
            steps.append(1.0)
            continue
        step = np.diff(np.asarray(volume.coords[dim], dtype=np.float64))
        if not np.allclose(step, step[0], rtol=1e-3):
            raise ValueError(f"coordinate '{dim}' has no constant step; give spacing")
        steps.append(abs(float(step[0])))
    return steps if len(steps) == 3 else [1.0, 1.0, 1.0]


def _like(volume, array):
    """A DataArray where the volume is one."""
    return volume.copy(data=array) if hasattr(volume, "dims") and hasattr(volume, "copy") else array


def _out(shape, out):
    if out is None:
        return np.empty(shape, np.float32)
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out is a {type(out).__name__}; it must be a float32 array")
    return out


def sweep_distance(volume, *, isovalue, spacing=None, slope=1.0, intercept=0.0, out=None, threads=0,
                   progress=None, **settings):
    texts = as_text("sweep_distance", {"isovalue": isovalue, **settings})
    if isinstance(volume, Volume):
        slope, intercept = volume.slope, volume.intercept
    array = _array("volume", volume)
    result = _out(np.shape(array), out)
    _library.distances(array, _spacing(volume, spacing), slope, intercept, texts, result, threads,
                       _progress(progress))
    return _like(volume, result)


class VisibilityField:
    """Ambient visibility in a volume, by octants of directions: what sweep_occlusion returns.

    shape, spacing, origin: of its own grid, which may be coarser than the volume's, as (z, y, x).
    """

    def __init__(self, swept):
        self._swept = swept
        self.shape = tuple(swept.shape())
        self.spacing = tuple(swept.spacing())
        self.origin = tuple(swept.origin())

    def octant(self, number):
        """Mean visibility of an octant at each sample of the field's own grid, (Z, Y, X). Bit 0, 1
        or 2 of `number` set: light from the positive side of x, y or z."""
        return self._swept.octant(number)

    def mean(self, *, threads=0, progress=None):
        """Mean visibility of all octants, (Z, Y, X), without the cosine to a surface."""
        return self._swept.scalar(threads, _progress(progress))

    def light(self, points, normals, *, octants=range(8), geometry_term=True, threads=0,
              progress=None):
        """Ambient visibility in [0, 1] at points of a surface.

        points: float32 array (N, 3), x, y and z; the voxel [k, j, i] of a volume with the spacing
            (sz, sy, sx) is the point (i sx, j sy, k sz).
        normals: float32 array (N, 3), unit vectors towards the open side.
        octants: those that light comes from.
        geometry_term: weigh by the cosine to the normal.
        """
        mask = 0
        for number in octants:
            if not 0 <= number <= 7:
                raise ValueError(f"octants has {number}; each must be in 0 to 7")
            mask |= 1 << number
        return self._swept.light(_array("points", points), _array("normals", normals), mask,
                                 geometry_term, threads, _progress(progress))


def sweep_occlusion(distance, *, spacing=None, threads=0, progress=None, **settings):
    texts = as_text("sweep_occlusion", settings)
    return VisibilityField(_library.occlusion(_array("distance", distance),
                                              _spacing(distance, spacing), texts, None, threads,
                                              _progress(progress)))


def sweep_shadow(distance, to_light, *, spacing=None, threads=0, progress=None, **settings):
    texts = as_text("sweep_occlusion", settings)
    direction = [float(v) for v in to_light]
    if len(direction) != 3:
        raise ValueError(f"to_light has {len(direction)} numbers; it must be (x, y, z)")
    return VisibilityField(_library.occlusion(_array("distance", distance),
                                              _spacing(distance, spacing), texts, direction,
                                              threads, _progress(progress)))


_AXES = """
    The axes are (z, y, x), the last one x, as in nearly every library of images; nibabel's arrays
    are (x, y, z): give `data.T`, which copies nothing. Vectors and points are (x, y, z)."""

sweep_distance.__doc__ = f"""Signed distance to an isosurface, by fast sweeping (Singh et al. 2011).

    volume: array (Z, Y, X) of uint8, int16, uint16 or float32, each side in [1, 8192], any strides,
        read in place. NaN is open. A DataArray comes back as one.
    isovalue: the value on the surface; a voxel of this value is matter.
    spacing: world units from voxel to voxel: a number, or (z, y, x); by default the steps of a
        DataArray's coordinates, else 1.
    slope, intercept: a voxel's value is slope * sample + intercept.
    out: a float32 array (Z, Y, X) to write to.
{_AXES}

    Returns a float32 array (Z, Y, X) in world units, positive in the open, negative in matter.
    Raises ValueError, with the range of values, where the isovalue cuts nothing.

Settings:
{table("sweep_distance")}
"""

sweep_occlusion.__doc__ = f"""Ambient visibility in a volume, by sweeps from eight octants (Singh et
    al. 2011).

    distance: float32 array (Z, Y, X) of sweep_distance; positive is open. Only values within two
        voxels of the surface count.
    spacing: as for sweep_distance.
{_AXES}

    Returns a VisibilityField.

Settings:
{table("sweep_occlusion")}
"""

sweep_shadow.__doc__ = """Soft shadow of one light, by a sweep on a grid turned towards it.

    distance, spacing, settings: as for sweep_occlusion.
    to_light: (x, y, z), of any length.

    Returns a VisibilityField; its light() gives the shadow at points, 1 is lit.
"""
