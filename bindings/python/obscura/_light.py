"""Environments, and light from visibility, bent normals and cones."""
import math

import numpy as np

from . import _library
from ._screen import _array, _like_image, _progress
from ._settings import as_text, table


class Environment:
    """Distant light: radiance by direction, and a sun. World space is right-handed with y up; a
    camera without rotation looks along -z."""

    def __init__(self, lights):
        self._lights = lights

    @staticmethod
    def sky(model="clear", **settings):
        return Environment(_library.Lights.sky(as_text("sky", {"model": model, **settings})))

    @staticmethod
    def lat_long(radiance):
        """From a latitude-longitude map of linear RGB, float32 (H, 2 H, 3): the top row is up, the
        middle column straight ahead (-z), right of it +x."""
        return Environment(_library.Lights.lat_long(_array("radiance", radiance)))

    def with_sun(self, direction, irradiance=(3, 3, 3), *, angular_radius_deg=0.27):
        """The same light with another sun. direction: towards it, (x, y, z); irradiance: RGB on a
        surface that faces it."""
        return Environment(self._lights.with_sun([float(v) for v in direction],
                                                 [float(v) for v in irradiance],
                                                 math.radians(angular_radius_deg)))

    def convolve(self, *, threads=0, progress=None, **settings):
        """Convolves the light for light(), which does it by itself at the default settings."""
        self._lights.convolve(as_text("preconvolution", settings), threads, _progress(progress))
        return self

    def radiance(self, direction):
        """RGB from a direction (x, y, z), without the sun."""
        return self._lights.radiance([float(v) for v in direction])


def light(visibility, *, environment, normal=None, bent_normal=None, cone_angle=None, albedo=None,
          world_from_eye=None, out=None, threads=0, progress=None, **settings):
    if not isinstance(environment, Environment):
        raise TypeError(f"environment is a {type(environment).__name__}; it must be an "
                        "obscura.Environment")
    texts = as_text("light", settings)
    array = _array("visibility", visibility)
    turn = np.eye(3) if world_from_eye is None else np.asarray(world_from_eye, dtype=np.float64)
    if turn.shape != (3, 3):
        raise ValueError(f"world_from_eye has shape {turn.shape}; it must be (3, 3)")
    if out is None:
        out = np.empty(np.shape(array) + (3,), np.float32)
    elif not isinstance(out, np.ndarray):
        raise TypeError(f"out is a {type(out).__name__}; it must be a float32 array")
    if not environment._lights.is_convolved():
        environment.convolve(threads=threads)
    _library.light(array, _array("normal", normal), _array("bent_normal", bent_normal),
                   _array("cone_angle", cone_angle), _array("albedo", albedo), environment._lights,
                   texts, turn.ravel().tolist(), out, threads, _progress(progress))
    return _like_image(visibility, out)


Environment.sky.__doc__ = f"""An analytic sky above a grey ground.

Settings:
{table("sky")}
"""

light.__doc__ = f"""The light that each pixel reflects, linear RGB (Klehm et al. 2011).

    visibility: float32 array (H, W), 1 is open.
    environment: obscura.Environment.
    normal, bent_normal: float32 arrays (H, W, 3) in eye space; needed where the technique takes
        them.
    cone_angle: float32 array (H, W) in radians.
    albedo: float32 array (H, W, 3); None: 1.
    world_from_eye: 3x3 rotation from eye space to the environment's world; None: none.

    Returns a float32 array (H, W, 3).

Settings:
{table("light")}
"""
