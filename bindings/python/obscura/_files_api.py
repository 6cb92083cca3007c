"""Files, meshes and scenes, pictures of volumes; the compiled part is loaded at the first use."""
import collections
import os

import numpy as np

from ._camera import Camera
from ._screen import _array, _progress, _results
from ._settings import as_text
from ._volume import Volume, _spacing

Comparison = collections.namedtuple(
    "Comparison", "e_a within_5 bias rmse maximum correlation pixels infinite")
Mesh = collections.namedtuple("Mesh", "vertices faces origin")


def _tools():
    try:
        from . import _files
    except ImportError as e:
        raise ImportError(f"this build of obscura reads no files: {e}") from None
    return _files


def _readable(path):
    """The name of a file; OSError where it cannot be opened."""
    name = os.fspath(path)
    with open(name, "rb"):
        return name


def _shape_text(shape):
    if shape is None:
        return {}
    height, width = (int(n) for n in shape)
    return {"size": f"{width}x{height}"}


class DepthImage:
    """A depth image with all that visibility() wants to know of it: of a file, mesh or scene.

    depth: float32 (H, W); normals: (H, W, 3) in eye space or None; back_depth: (H, W) or None;
    layers: [(front, back), ...]; camera; guard_band: (left, right, top, bottom); depth_kind, near,
    far; world_from_eye: 3x3 rotation; notes: what was found on reading, a line each.
    """

    def __init__(self, seen):
        self._seen = seen
        self.depth = seen.depth()
        self.normals = seen.normals()
        self.back_depth = seen.back_depth()
        self.layers = seen.layers()
        self.guard_band = tuple(seen.guard_band())
        self.depth_kind, self.near, self.far = seen.kind()
        self.notes = seen.notes()
        self.world_from_eye = np.array(seen.world_from_eye()).reshape(3, 3)
        numbers = seen.camera()
        self.camera = Camera(lambda w, h, g: numbers, "of a file")

    def inputs(self):
        """The keywords of visibility(): obscura.visibility(**image.inputs(), radius=2)."""
        return {"depth": self.depth, "camera": self.camera, "normals": self.normals,
                "guard_band": self.guard_band, "back_depth": self.back_depth,
                "layers": self.layers or None, "depth_kind": self.depth_kind, "near": self.near,
                "far": self.far}

    def visible(self, array):
        """The visible part of an array of the whole image."""
        left, right, top, bottom = self.guard_band
        return array[top:array.shape[0] - bottom, left:array.shape[1] - right]

    def truth(self, *, outputs=("visibility",), out=None, threads=0, progress=None, **settings):
        """Visibility by rays against the geometry itself, also what the camera does not see; of
        meshes and scenes. Outputs are visibility, bent_normal, cone_angle and standard_error;
        obscura.settings("truth") lists the settings."""
        texts = as_text("truth", settings)
        arrays = _results(outputs, out, self.visible(self.depth).shape)
        self._seen.truth(texts, arrays, threads, _progress(progress))
        results = dict(arrays)
        return results if len(results) > 1 else next(iter(results.values()))


def gbuffer(source, *, shape=None, threads=0, **settings):
    """What a camera sees of a mesh or scene: a DepthImage.

    source: the name of a mesh file (.obj, .ply, .gltf, .glb) or "scene:NAME" (docs/scenes.md).
    shape: (H, W) of the visible part.
    settings: of the view; obscura.settings("gbuffer") lists them. Without eye and look_at the whole
        mesh is shown, or the scene's own view.
    """
    texts = as_text("gbuffer", {**_shape_text(shape), **settings})
    name = os.fspath(source)
    if not name.startswith("scene:"):
        name = _readable(name)
    return DepthImage(_tools().see_file(name, texts, threads))


def mesh_visibility(vertices, faces, points=None, normals=None, *, bent_normals=False, threads=0,
                    progress=None, **settings):
    """Ambient visibility at points of a mesh, by rays, for baking.

    vertices: float32 array (V, 3); faces: uint32 array (F, 3) of indices. Both sides of a triangle
        hide the light.
    points, normals: float32 arrays (N, 3) in the space of the vertices; normals of any length above
        0. Without them the vertices themselves, with the mean of their faces' normals by area,
        counterclockwise seen from outside.
    settings: obscura.settings("mesh_visibility") lists them; radius is in the unit of the vertices,
        inf with falloff="constant" for the whole mesh.

    Returns float32 (N,), 1 is open; with bent_normals the pair of it and the mean open directions,
    float32 (N, 3), unit vectors.
    """
    texts = as_text("mesh_visibility", settings)
    v, f = _array("vertices", vertices), _array("faces", faces)
    if (points is None) != (normals is None):
        raise TypeError("points and normals go together; give both or neither")
    if points is not None:
        points, normals = _array("points", points), _array("normals", normals)
    visible, bent = _tools().points_of_mesh(v, f, points, normals, bool(bent_normals), texts,
                                            threads, _progress(progress))
    return (visible, bent) if bent_normals else visible


def read_depth(path, **settings):
    """A depth image of an EXR, PFM or 16-bit PNG file with its camera, normals and guard band: a
    DepthImage. obscura.settings("read_depth") lists what a file may not say by itself, such as
    fov_y in degrees."""
    return DepthImage(_tools().read_depth(_readable(path), as_text("read_depth", settings)))


def read(path, *, volume_index=None, threads=0):
    """Reads a file by its ending.

    .exr, .pfm, .png, .hdr: a dict of float32 arrays (H, W) by the names of channels.
    .nii, .nii.gz, .nrrd, .nhdr: an obscura.Volume; volume_index chooses one of several in NIfTI.
    .obj, .ply, .gltf, .glb: a Mesh of vertices, float32 (N, 3), relative to origin, (x, y, z), and
        faces, uint32 (M, 3).

    Depth images with their cameras: read_depth. A procedural volume, "volume:NAME", is read too.
    """
    tools = _tools()
    name = os.fspath(path)
    if not name.startswith("volume:"):
        name = _readable(name)
    if tools.is_volume(name):
        return Volume._of_file(tools, tools.read_volume(name, volume_index, threads))
    if tools.is_mesh(name):
        return Mesh(*tools.read_mesh(name))
    return dict(tools.read_channels(name))


def write(path, data, *, spacing=None, half=False, png_bits=8):
    """Writes a file by its ending; it is whole or not there.

    .exr, .pfm, .png: an array (H, W) or (H, W, 3) of float32, or a dict of arrays (H, W) by the
        names of channels. PNG takes values in [0, 1].
    .nrrd: an array (Z, Y, X) of float32, with `spacing` as for sweep_distance.
    """
    name = os.fspath(path)
    folder = os.path.dirname(name) or "."
    if not os.path.isdir(folder):
        raise FileNotFoundError(2, "No such folder", folder)
    if name.lower().endswith(".nrrd"):
        _tools().write_volume(name, _array("data", data), _spacing(data, spacing))
        return
    if isinstance(data, dict):
        channels = [(key, _array(key, value)) for key, value in data.items()]
    else:
        array = _array("data", data)
        if np.ndim(array) == 3 and np.shape(array)[2] == 3:
            channels = [(c, array[..., i]) for i, c in enumerate("RGB")]
        else:
            channels = [("Y", array)]
    if not channels:
        raise ValueError("data has no channel")
    _tools().write_channels(name, channels, half, png_bits)


def compare(image, reference, *, mask=None):
    """How an image differs from a reference, as `obscura compare` says it: a named tuple of e_a
    (mean |difference|), bias, rmse and maximum in per cent of full scale, within_5 (per cent of
    pixels that differ by less than 0.05), correlation, pixels (counted), infinite (in one only).

    image, reference: float32 arrays (H, W); NaN is left out. A reference that is N times smaller is
        compared with every N-th pixel.
    mask: a depth image; pixels that are not finite in it are left out.
    """
    figures = dict(_tools().difference(_array("image", image), _array("reference", reference),
                                       _array("mask", mask)))
    return Comparison(**{**figures, "pixels": int(figures["pixels"]),
                         "infinite": int(figures["infinite"])})


def volume_picture(volume, *, isovalue=None, light="lit", shape=None, spacing=None, slope=1.0,
                   intercept=0.0, gamma=2.0, threads=0, progress=None, **settings):
    """A picture of an isosurface of a volume.

    volume: array (Z, Y, X) as for sweep_distance, or an obscura.Volume, which knows its spacing,
        place in the world and perhaps its isovalue.
    light: "lit" gives a picture in colours, float32 (H, W, 3) for a screen; the others visibility,
        float32 (H, W): "ao", "headlight", "octants:0,1,...", "octants:upper", "shadow:X,Y,Z",
        "translucent:ALPHA".
    shape: (H, W) of the picture.
    gamma: of "lit".
    settings: obscura.settings("volume_picture") lists them; eye, look_at and up are (x, y, z).
    """
    place = None
    if isinstance(volume, Volume):
        place = volume._loaded
        slope, intercept = volume.slope, volume.intercept
        if isovalue is None:
            isovalue = volume.isovalue
        if volume.solid is not None:
            settings.setdefault("solid", volume.solid)
    if isovalue is None:
        raise TypeError("isovalue is missing: the value on the surface")
    texts = as_text("volume_picture", {**_shape_text(shape), "isovalue": isovalue, **settings})
    steps = _spacing(volume, spacing)
    return _tools().picture(_array("volume", volume), steps, slope, intercept, place, light,
                            float(gamma), texts, threads, _progress(progress))
