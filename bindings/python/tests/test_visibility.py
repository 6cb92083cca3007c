"""obscura.visibility: answers on paper, arrays of every kind, errors, threads."""
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import obscura

CAMERA = obscura.Camera.perspective(fov_y_deg=50)


def wall(h=36, w=64, d=5.0):
    return np.full((h, w), d, np.float32)


def step(h=36, w=64):
    depth = wall(h, w)
    depth[h // 3: 2 * h // 3, w // 3: 2 * w // 3] = 4
    return depth


@pytest.mark.parametrize("method", [m for m in obscura.methods() if m != "ray-traced"])
def test_a_wall_is_open(method):
    v = obscura.visibility(wall(), camera=CAMERA, method=method, radius=1)
    assert v.dtype == np.float32 and v.shape == (36, 64)
    assert np.abs(v - 1).max() < 0.02 if method != "area" else np.abs(v[8:-8, 8:-8] - 1).max() < 0.02


def test_a_step_darkens_its_foot_and_a_thread_more_changes_nothing():
    one = obscura.visibility(step(), camera=CAMERA, radius=2, threads=1)
    two = obscura.visibility(step(), camera=CAMERA, radius=2, threads=2)
    assert one.min() < 0.95 and (one == two).all()


def test_background_is_open():
    depth = step()
    for nothing in (np.inf, np.nan, 1e10, 3e38):
        depth[:8] = nothing
        v = obscura.visibility(depth, camera=CAMERA, radius=1)
        assert (v[:8] == 1).all() and np.isfinite(v).all()


def test_several_outputs_and_given_arrays():
    out = {"visibility": np.zeros((36, 64), np.float32)}
    r = obscura.visibility(step(), camera=CAMERA, radius=1, out=out,
                           outputs=("visibility", "bent_normal", "cone_angle"))
    assert r["visibility"] is out["visibility"] and out["visibility"].max() > 0.9
    assert np.allclose(np.linalg.norm(r["bent_normal"], axis=2), 1, atol=1e-4)
    assert r["cone_angle"].shape == (36, 64)
    single = np.empty((36, 64), np.float32)
    assert obscura.visibility(step(), camera=CAMERA, radius=1, out=single) is single
    assert (single == r["visibility"]).all()


def test_guard_band_and_orthographic():
    v = obscura.visibility(step(), camera=obscura.Camera.orthographic(height=3), radius=1,
                           guard_band=(4, 2))
    assert v.shape == (32, 56)


def test_any_strides_without_a_copy():
    depth = step()
    right = obscura.visibility(depth, camera=CAMERA, radius=1)
    stack = np.zeros((36, 64, 3), np.float32)
    stack[..., 1] = depth
    flipped = np.ascontiguousarray(depth[::-1])
    read_only = depth.copy()
    read_only.flags.writeable = False
    for same in (np.asfortranarray(depth), stack[..., 1], flipped[::-1], read_only):
        assert (obscura.visibility(same, camera=CAMERA, radius=1) == right).all()


def test_what_shows_itself_as_an_array():
    class Interface:
        def __init__(self, array):
            self.__array_interface__ = array.__array_interface__
            self.keep = array

    class Dlpack:
        def __init__(self, array):
            self.array = array

        def __dlpack__(self, **kwargs):
            return self.array.__dlpack__(**kwargs)

        def __dlpack_device__(self):
            return self.array.__dlpack_device__()

    right = obscura.visibility(step(), camera=CAMERA, radius=1)
    for thing in (Interface(step()), Dlpack(step())):
        assert (obscura.visibility(thing, camera=CAMERA, radius=1) == right).all()


def test_data_arrays_come_back_as_such():
    xarray = pytest.importorskip("xarray")
    depth = xarray.DataArray(step(), dims=("y", "x"), coords={"y": np.arange(36), "x": np.arange(64)})
    v = obscura.visibility(depth, camera=CAMERA, radius=1, guard_band=2)
    assert v.dims == ("y", "x") and v.y[0] == 2 and v.shape == (32, 60)


@pytest.mark.parametrize("depth, error, words", [
    (step().astype(np.float64), TypeError, "depth is float64; it must be float32"),
    (step().astype(">f4"), TypeError, "float32"),
    (np.ma.masked_greater(step(), 4.5), TypeError, "masked"),
    (step()[0], ValueError, r"depth has shape \(64,\)"),
    (np.zeros((0, 4), np.float32), ValueError, "at least 1"),
    ([[1.0, 2.0]], TypeError, "depth is a list"),
    (None, TypeError, "depth is None"),
    (-step(), ValueError, "depth at pixel"),
])
def test_arrays_that_cannot_be_read(depth, error, words):
    with pytest.raises(error, match=words):
        obscura.visibility(depth, camera=CAMERA, radius=1)


@pytest.mark.parametrize("keywords, error, words", [
    ({"method": "ssao"}, ValueError, "there is no method 'ssao'; there are"),
    ({"radius": -1}, ValueError, "radius"),
    ({"radios": 1}, TypeError, "no setting 'radios'; it has"),
    ({"outputs": "normals"}, ValueError, "no output 'normals'; there are"),
    ({"outputs": ()}, ValueError, "outputs is empty"),
    ({"guard_band": -1}, ValueError, "guard_band"),
    ({"guard_band": 30}, ValueError, "at least 1"),
    ({"normals": step()}, ValueError, r"normals has shape \(36, 64\)"),
    ({"camera": 50}, TypeError, "obscura.Camera"),
    ({"out": np.empty((3, 3), np.float32)}, ValueError, "its image has 36 rows and 64 columns"),
    ({"depth_kind": "z"}, ValueError, "depth_kind is 'z'; it must be"),
    ({"occluder": "back-depth"}, ValueError, "back_depth"),
])
def test_mistakes_are_named(keywords, error, words):
    with pytest.raises(error, match=words):
        obscura.visibility(step(), **{"camera": CAMERA, "radius": 1, **keywords})


def test_every_setting_has_its_line_in_the_help():
    for method in obscura.methods():
        for name in obscura.settings(method):
            assert f"    {name}: " in obscura.visibility.__doc__


def test_frames_are_as_single_calls():
    frames = obscura.Estimator("horizon", shape=(36, 64), radius=1)
    for depth in (step(), wall(), step()):
        a = frames.run(depth, camera=CAMERA)
        assert (a == obscura.visibility(depth, camera=CAMERA, method="horizon", radius=1)).all()
    with pytest.raises(ValueError):
        frames.run(step(20, 20), camera=CAMERA)


def test_small_images():
    for shape in ((1, 1), (1, 7), (7, 1)):
        assert (obscura.visibility(np.ones(shape, np.float32), camera=CAMERA, radius=1) >= 0).all()


def test_many_calls_take_no_more_memory():
    depth = wall(8, 8)
    frames = obscura.Estimator("line", shape=(8, 8), radius=1)

    def calls(n):
        for _ in range(n):
            frames.run(depth, camera=CAMERA, threads=1)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = calls(500)
    assert calls(10000) - before < 3000  # kB


def test_threads_call_at_once():
    right = obscura.visibility(step(), camera=CAMERA, radius=1)
    results = []

    def call():
        for _ in range(5):
            results.append(obscura.visibility(step(), camera=CAMERA, radius=1))

    threads = [threading.Thread(target=call) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(results) == 20 and all((r == right).all() for r in results)


def in_child(queue):
    queue.put(obscura.visibility(step(), camera=CAMERA, radius=1).sum())


def test_forked_children_work():
    right = obscura.visibility(step(), camera=CAMERA, radius=1).sum()
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=in_child, args=(queue,))
    child.start()
    assert queue.get(timeout=60) == right
    child.join()


def test_progress_is_told_and_its_exceptions_come_through():
    depth = step(360, 640)
    told = []
    obscura.visibility(depth, camera=CAMERA, method="ray-traced", rays=64, radius=1,
                       progress=told.append)
    assert told[-1] == 1 and all(0 <= s <= 1 for s in told)

    def stop(share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        obscura.visibility(depth, camera=CAMERA, method="ray-traced", rays=4096, radius=1,
                           progress=stop)


def test_an_interrupt_stops_a_long_run():
    code = """
import numpy as np, obscura
try:
    obscura.visibility(np.random.rand(1000, 1000).astype('f4') + 1, method='ray-traced', rays=4000,
                       radius=1, camera=obscura.Camera.perspective(fov_y_deg=50))
except KeyboardInterrupt:
    print('stopped')
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    time.sleep(2)
    child.send_signal(signal.SIGINT)
    start = time.monotonic()
    assert child.communicate(timeout=60)[0] == b"stopped\n"
    assert time.monotonic() - start < 10  # a tenth of a second on an idle machine


def test_import_is_quick():
    code = ("import numpy, time; t = time.perf_counter(); import obscura; "
            "print(time.perf_counter() - t)")
    times = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True,
                                  env=os.environ).stdout) for _ in range(3)]
    assert min(times) < 0.5  # 0.05 on an idle machine
