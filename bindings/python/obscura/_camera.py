"""Cameras, as the library knows them once the size of an image is known."""
import math

from . import _library


class Camera:
    """How pixels become eye space: made by one of the functions below.

    A camera is that of the visible part of an image; guard bands lie around it.
    """

    def __init__(self, resolve, text):
        self._resolve = resolve
        self._text = text

    def __repr__(self):
        return f"obscura.Camera.{self._text}"

    @staticmethod
    def perspective(*, fov_y_deg):
        """A symmetric view of `fov_y_deg` degrees from bottom to top, in (0, 180)."""
        if not 0 < fov_y_deg < 180:
            raise ValueError(f"fov_y_deg is {fov_y_deg}; it must be in (0, 180)")
        return Camera(lambda w, h, g: _library.perspective(math.radians(fov_y_deg), w, h, g),
                      f"perspective(fov_y_deg={fov_y_deg})")

    @staticmethod
    def orthographic(*, height):
        """A parallel view, `height` world units from bottom to top."""
        if not 0 < height < math.inf:
            raise ValueError(f"height is {height}; it must be in (0, inf)")
        return Camera(lambda w, h, g: _library.orthographic(height, w, h, g),
                      f"orthographic(height={height})")

    @staticmethod
    def intrinsics(fx, fy, cx, cy):
        """A pinhole camera in pixels: focal lengths, and the principal point from the upper left
        corner, where pixel centres are at halves (OpenCV counts from a centre: add 0.5)."""
        if not (0 < fx < math.inf and 0 < fy < math.inf):
            raise ValueError(f"focal lengths are {fx} and {fy}; both must be in (0, inf)")
        return Camera(lambda w, h, g: (False, 1 / fx, 1 / fy, g[0] + cx, g[2] + cy),
                      f"intrinsics({fx}, {fy}, {cx}, {cy})")

    @staticmethod
    def from_projection(matrix):
        """From a 4x4 projection matrix for column vectors, with last row 0 0 -1 0 (perspective) or
        0 0 0 1 (parallel)."""
        numbers = [float(v) for row in matrix for v in row]
        if len(numbers) != 16:
            raise ValueError(f"matrix has {len(numbers)} numbers; it must have 4 rows of 4")
        return Camera(lambda w, h, g: _library.from_projection(numbers, w, h, g),
                      "from_projection(...)")
