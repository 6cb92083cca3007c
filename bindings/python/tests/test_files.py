"""Files, meshes, scenes and pictures of volumes."""
import gzip
import os
import struct

import numpy as np
import pytest

import obscura

pytest.importorskip("obscura._files")


def test_images_come_back(tmp_path):
    rng = np.random.default_rng(1)
    a, rgb = rng.random((5, 7), np.float32), rng.random((5, 7, 3), np.float32)
    for name in ("a.exr", "a.pfm"):
        obscura.write(tmp_path / name, a)
        (back,) = obscura.read(tmp_path / name).values()
        assert back.dtype == np.float32 and (back == a).all()
    obscura.write(tmp_path / "rgb.exr", rgb[:, ::-1])
    back = obscura.read(tmp_path / "rgb.exr")
    assert set(back) == set("RGB") and (back["G"] == rgb[:, ::-1, 1]).all()
    obscura.write(tmp_path / "c.png", a, png_bits=16)
    (back,) = obscura.read(tmp_path / "c.png").values()
    assert np.abs(back - a).max() < 1e-4
    obscura.write(tmp_path / "many.exr", {"visibility": a, "Z": 1 + a})
    assert (obscura.read(tmp_path / "many.exr")["Z"] == 1 + a).all()


def nifti(path, data_xyz, spacing):
    """A NIfTI-1 file of float32, without an orientation."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *data_xyz.shape, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 16, 32)
    struct.pack_into("<8f", header, 76, 1, *spacing, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352)
    header[344:348] = b"n+1\0"
    with gzip.open(path, "wb") as f:
        f.write(bytes(header) + np.asfortranarray(data_xyz).tobytes(order="F"))


def test_a_volume_file_has_its_axes_in_order(tmp_path):
    xyz = np.random.default_rng(2).random((4, 5, 6), np.float32)
    nifti(tmp_path / "v.nii.gz", xyz, (0.5, 1, 2))
    v = obscura.read(tmp_path / "v.nii.gz")
    assert v.array.shape == (6, 5, 4) and (v.array == xyz.T).all() and v.spacing == (2, 1, 0.5)
    obscura.write(tmp_path / "v.nrrd", np.ascontiguousarray(v.array), spacing=v.spacing)
    again = obscura.read(tmp_path / "v.nrrd")
    assert (again.array == xyz.T).all() and again.spacing == (2, 1, 0.5)
    d = obscura.sweep_distance(v, isovalue=0.5)
    assert (d == obscura.sweep_distance(xyz.T, isovalue=0.5, spacing=(2, 1, 0.5))).all()


def box_volume():
    """A bar along +x, low in y, in a cube of 24 voxels."""
    v = np.zeros((24, 24, 24), np.float32)
    v[8:12, 4:8, 4:20] = 1
    return v


def test_a_picture_is_not_mirrored():
    view = dict(isovalue=0.5, light="headlight", shape=(64, 64), look_at=(12, 12, 12), ortho_height=24,
                samples_per_pixel=1)
    along_z = obscura.volume_picture(box_volume(), eye=(12, 12, 100), up=(0, 1, 0), **view)
    rows, columns = np.nonzero(along_z != 1)
    assert along_z.shape == (64, 64)
    # y 4 to 8 of 24 is in the lower half; x 4 to 20 to the right of the left edge.
    assert rows.min() > 32 and abs(columns.mean() - 31) < 2 and np.ptp(columns) > 35
    v = box_volume()
    v[:, :, :12] = 0  # x 12 to 20: on the right
    rows, columns = np.nonzero(obscura.volume_picture(v, eye=(12, 12, 100), up=(0, 1, 0), **view) != 1)
    assert columns.min() > 28


def test_lit_pictures_have_colours():
    p = obscura.volume_picture(box_volume(), isovalue=0.5, shape=(48, 64), background_colour=(0, 0, 1))
    assert p.shape == (48, 64, 3) and p.min() >= 0 and p.max() <= 1
    assert np.allclose(p[0, 0], [0, 0, 1], atol=1e-3) and p[24, 32, 0] > 0.1
    mean = {light: obscura.volume_picture(box_volume(), isovalue=0.5, shape=(48, 64),
                                          light=light).mean() for light in ("ao", "shadow:0,0,1")}
    assert 0.3 < mean["ao"] < 1 and 0.3 < mean["shadow:0,0,1"] < 1


def quad(path):
    with open(path, "w", encoding="ascii") as f:
        f.write("v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3\nf 1 3 2\n")
    return path


def test_a_mesh_from_above(tmp_path):
    path = quad(tmp_path / "quad.obj")
    mesh = obscura.read(path)
    assert mesh.vertices.shape == (4, 3) and mesh.faces.shape == (2, 3)
    g = obscura.gbuffer(path, shape=(20, 30), eye=(0, 5, 0), look_at=(0, 0, 0), up=(0, 0, -1),
                        ortho_height=1, guard_band=4)
    assert g.depth.shape == (28, 38) and g.guard_band == (4, 4, 4, 4)
    assert np.allclose(g.depth, 5) and np.allclose(g.normals, [0, 0, 1])
    assert np.allclose(g.world_from_eye @ [0, 0, 1], [0, 1, 0])
    v = obscura.visibility(**g.inputs(), radius=1)
    assert v.shape == (20, 30) and np.allclose(v, 1, atol=0.01)
    assert (g.truth(rays=16) == 1).all()


def test_scenes_and_their_truth():
    g = obscura.gbuffer("scene:groove", shape=(90, 160))
    truth = g.truth(rays=64, radius=1)
    # In a groove the first layer is all there is: rays through the image find the same.
    v = obscura.visibility(**g.inputs(), method="ray-traced", rays=64, radius=1)
    c = obscura.compare(v, truth, mask=g.visible(g.depth))
    assert c.pixels == 90 * 160 and c.e_a < 0.8 and c.correlation > 0.98
    r = g.truth(rays=16, outputs=("visibility", "bent_normal"))
    assert np.allclose(np.linalg.norm(r["bent_normal"], axis=2), 1, atol=1e-4)


def test_depth_files_bring_their_camera(tmp_path):
    depth = np.full((9, 16), 3, np.float32)
    obscura.write(tmp_path / "d.pfm", depth)
    d = obscura.read_depth(tmp_path / "d.pfm", fov_y=50)
    a = obscura.visibility(**d.inputs(), radius=1)
    camera = obscura.Camera.perspective(fov_y_deg=50)
    assert (a == obscura.visibility(depth, camera=camera, radius=1)).all()


def test_compare_on_paper():
    a = np.zeros((10, 10), np.float32)
    b = a.copy()
    b[:5] = 0.1
    b[0, 0] = np.nan
    c = obscura.compare(a, b)
    assert c.pixels == 99 and abs(c.e_a - 100 * 0.1 * 49 / 99) < 1e-4 and c.bias < 0
    assert abs(c.within_5 - 100 * 50 / 99) < 1e-4 and abs(c.maximum - 10) < 1e-4
    assert obscura.compare(a, a).e_a == 0


@pytest.mark.parametrize("make, error, words", [
    (lambda d: obscura.read(d / "none.exr"), FileNotFoundError, "none.exr"),
    (lambda d: obscura.gbuffer(d / "none.obj"), FileNotFoundError, "none.obj"),
    (lambda d: obscura.gbuffer("scene:nowhere"), ValueError, "nowhere"),
    (lambda d: obscura.gbuffer("scene:hall", sise=3), TypeError, "no setting 'sise'"),
    (lambda d: obscura.write(d / "no" / "a.exr", np.ones((2, 2), np.float32)), FileNotFoundError,
     "folder"),
    (lambda d: obscura.write(d / "a.tga", np.ones((2, 2), np.float32)), ValueError, "tga"),
    (lambda d: obscura.write(d / "a.exr", np.ones((2, 2))), TypeError, "float64"),
    (lambda d: obscura.write(d / "a.exr", {}), ValueError, "no channel"),
    (lambda d: obscura.compare(np.ones((4, 4), np.float32), np.ones((3, 3), np.float32)), ValueError,
     "3"),
    (lambda d: obscura.volume_picture(box_volume()), TypeError, "isovalue is missing"),
    (lambda d: obscura.volume_picture(box_volume(), isovalue=0.5, light="sun"), ValueError,
     "light is 'sun'"),
    (lambda d: obscura.volume_picture(box_volume(), isovalue=9), ValueError, "isovalue"),
])
def test_mistakes_are_named(tmp_path, make, error, words):
    with pytest.raises(error, match=words):
        make(tmp_path)
    assert not os.listdir(tmp_path)


def test_damaged_files_are_refused(tmp_path):
    for name in ("a.exr", "a.png", "a.ply", "a.nrrd", "a.nii"):
        (tmp_path / name).write_bytes(b"\x00garbage" * 9)
        with pytest.raises(ValueError, match=name):
            obscura.read(tmp_path / name)
