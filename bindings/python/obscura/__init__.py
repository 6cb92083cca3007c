"""Ambient visibility: ambient occlusion, bent normals and cones of depth images.

    import obscura
    v = obscura.visibility(depth, camera=obscura.Camera.perspective(fov_y_deg=50), radius=2)

Images are float32 arrays of shape (H, W) with row 0 on top, vectors (H, W, 3) in eye space: x right,
y up, z towards the camera. Depth is positive; +inf is background.
"""
from ._camera import Camera
from ._files_api import (Comparison, DepthImage, Mesh, compare, gbuffer, mesh_visibility, read,
                         read_depth, volume_picture, write)
from ._light import Environment, light
from ._screen import Estimator, visibility
from ._settings import methods, settings
from ._terrain import terrain
from ._volume import VisibilityField, Volume, sweep_distance, sweep_occlusion, sweep_shadow

from ._library import version as _version

__version__ = _version()
__all__ = ["Camera", "Comparison", "DepthImage", "Environment", "Estimator", "Mesh",
           "VisibilityField", "Volume", "compare", "gbuffer", "light", "mesh_visibility", "methods",
           "read", "read_depth", "settings", "sweep_distance", "sweep_occlusion", "sweep_shadow", "terrain",
           "visibility", "volume_picture", "write"]
