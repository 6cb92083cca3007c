"""What is promised of size, memory, interrupts and arrays that change hands."""
import glob
import os
import shutil
import subprocess
import threading
import time
import tracemalloc

import numpy as np
import pytest

import obscura

CAMERA = obscura.Camera.perspective(fov_y_deg=50)


def step(h, w):
    depth = np.full((h, w), 5, np.float32)
    depth[h // 3: 2 * h // 3, w // 3: 2 * w // 3] = 4
    return depth


def test_the_compiled_parts_are_small(tmp_path):
    if not shutil.which("strip"):
        pytest.skip("strip is not installed")
    total = 0
    for path in glob.glob(os.path.join(os.path.dirname(obscura.__file__), "*.so")):
        copy = shutil.copy(path, tmp_path)
        subprocess.run(["strip", "--strip-unneeded", copy], check=True)
        total += os.path.getsize(copy)
    assert 100_000 < total < 10_000_000


@pytest.mark.parametrize("make", [np.asarray, np.asfortranarray, lambda a: a[::-1],
                                  lambda a: np.repeat(a, 2, axis=1)[:, ::2]])
def test_depth_is_not_copied(make):
    depth = make(step(720, 1280))
    depth.flags.writeable = False
    out = np.empty((720, 1280), np.float32)
    frames = obscura.Estimator("line", shape=(720, 1280), radius=1)
    tracemalloc.start()
    try:
        assert frames.run(depth, camera=CAMERA, out=out) is out
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000 < depth.nbytes  # NumPy tells of every array that it makes


def test_results_are_written_where_they_are_wanted():
    large = np.full((40, 60), -1, np.float32)
    address = large.__array_interface__["data"][0]
    obscura.visibility(step(20, 30), camera=CAMERA, radius=1, out=large[10:30, 20:50])
    assert large.__array_interface__["data"][0] == address
    assert (large[10:30, 20:50] >= 0).all() and (large != -1).sum() == 600


@pytest.mark.parametrize("method", obscura.methods())
def test_an_exception_of_progress_comes_through(method):
    def stop(share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        obscura.visibility(step(360, 640), camera=CAMERA, method=method, radius=1, progress=stop)


@pytest.mark.parametrize("method", obscura.methods())
def test_an_interrupt_stops_every_method(method):
    depth = step(720, 1280)
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), 2)

    timer = threading.Timer(0.2, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            obscura.visibility(depth, camera=CAMERA, method=method, radius=1)
    assert time.monotonic() - sent[0] < 10  # a tenth of a second on an idle machine


def test_an_array_in_use_is_neither_resized_nor_freed():
    right = obscura.visibility(step(360, 640), camera=CAMERA, method="ray-traced", rays=64, radius=1)
    held = [step(360, 640)]
    result = []
    started = threading.Event()

    def compute():
        depth = held[0]
        result.append(obscura.visibility(depth, camera=CAMERA, method="ray-traced", rays=64, radius=1,
                                         progress=lambda share: started.set()))

    thread = threading.Thread(target=compute)
    thread.start()
    assert started.wait(60)
    with pytest.raises(ValueError):
        held[0].resize((10, 10))
    held.clear()
    junk = [np.random.default_rng(i).random((360, 640), np.float32) for i in range(20)]
    thread.join()
    assert len(junk) == 20 and (result[0] == right).all()
