"""obscura.light: figures on paper."""
import numpy as np
import pytest

import obscura

UP = np.zeros((6, 8, 3), np.float32)
UP[..., 1] = 1
OPEN = np.ones((6, 8), np.float32)


def uniform():
    return obscura.Environment.sky("uniform")


def test_uniform_light_shows_visibility():
    for v in (1.0, 0.25):
        r = obscura.light(v * OPEN, normal=UP, environment=uniform(),
                          technique="ambient-occlusion")
        assert r.shape == (6, 8, 3) and np.allclose(r, v, atol=0.01)


@pytest.mark.parametrize("technique", ["bent-normal", "bent-cone"])
def test_every_technique_is_white_under_uniform_light(technique):
    r = obscura.light(OPEN, normal=UP, bent_normal=UP, cone_angle=np.pi / 2 * OPEN,
                      environment=uniform(), technique=technique)
    assert np.allclose(r, 1, atol=0.01)


def test_albedo_and_sun():
    albedo = np.zeros((6, 8, 3), np.float32) + np.array([0.5, 0.25, 0], np.float32)
    dark = obscura.Environment.sky("uniform", intensity=0).with_sun((0, 1, 0), (np.pi, 0, 0))
    r = obscura.light(OPEN, normal=UP, environment=dark, technique="ambient-occlusion")
    assert np.allclose(r, [1, 0, 0], atol=0.01)  # E/pi times the cosine, 1
    r = obscura.light(OPEN, normal=UP, albedo=albedo, environment=uniform(),
                      technique="ambient-occlusion")
    assert np.allclose(r, [0.5, 0.25, 0], atol=0.01)


def test_the_camera_turns_in_the_world():
    sky = obscura.Environment.sky("overcast", ground_albedo=0)
    upside_down = np.diag([-1, -1, 1])
    up, down = (obscura.light(OPEN, normal=UP, environment=sky, world_from_eye=turn,
                              technique="ambient-occlusion").mean() for turn in (None, upside_down))
    assert up > 0.9 and down < 0.05


def test_a_map_of_one_bright_half():
    radiance = np.zeros((32, 64, 3), np.float32)
    radiance[:, 32:] = 1  # +x
    e = obscura.Environment.lat_long(radiance)
    assert np.allclose(e.radiance((1, 0, 0)), 1) and np.allclose(e.radiance((-1, 0, 0)), 0)
    r = obscura.light(OPEN, normal=UP, environment=e, technique="ambient-occlusion")
    assert np.allclose(r, 0.5, atol=0.02)


def test_what_an_estimator_gives_goes_in():
    depth = np.full((36, 64), 5, np.float32)
    depth[12:24, 20:40] = 4
    r = obscura.visibility(depth, camera=obscura.Camera.perspective(fov_y_deg=50), radius=2,
                           outputs=("visibility", "normal", "bent_normal", "cone_angle"))
    lit = obscura.light(r["visibility"], normal=r["normal"], bent_normal=r["bent_normal"],
                        cone_angle=r["cone_angle"], environment=uniform())
    assert np.allclose(lit, r["visibility"][..., None], atol=0.02)


@pytest.mark.parametrize("keywords, error, words", [
    ({"environment": None}, TypeError, "environment is a NoneType; it must be an"),
    ({"environment": 0, "normal": UP}, TypeError, "environment is a int"),
    ({"normal": UP[:3]}, ValueError, "normal"),
    ({"normal": UP.astype(float)}, TypeError, "normal is float64"),
    ({"normal": UP, "technique": "cone"}, ValueError, "technique"),
    ({"normal": UP, "techniqe": "cone"}, TypeError, "no setting 'techniqe'"),
    ({"normal": UP, "world_from_eye": np.eye(4)}, ValueError, "world_from_eye"),
    ({"normal": UP, "world_from_eye": 2 * np.eye(3)}, ValueError, "world_from_eye"),
])
def test_mistakes_are_named(keywords, error, words):
    keywords = {"environment": uniform(), "technique": "ambient-occlusion", **keywords}
    with pytest.raises(error, match=words):
        obscura.light(OPEN, **keywords)


@pytest.mark.parametrize("make, words", [
    (lambda: obscura.Environment.sky("cloudy"), "model"),
    (lambda: obscura.Environment.sky(turbidity=1), "turbidity"),
    (lambda: obscura.Environment.lat_long(np.zeros((4, 4, 3), np.float32)), "twice"),
    (lambda: uniform().with_sun((0, 0, 0)), "direction"),
])
def test_environments_are_checked(make, words):
    with pytest.raises(ValueError, match=words):
        make()
