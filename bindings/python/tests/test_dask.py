"""obscura.dask: chunks have the bits of the whole, and a killed worker loses nothing."""
import os
import signal

import numpy as np
import pytest

import obscura

da = pytest.importorskip("dask.array")
import obscura.dask  # noqa: E402


def hills(h=90, w=130):
    y, x = np.mgrid[:h, :w]
    rough = np.random.default_rng(3).random((h, w))
    return (40 * np.sin(x / 9) * np.cos(y / 7) + 3 * rough + 500).astype(np.float32)


@pytest.mark.parametrize("chunks", [(45, 65), (90, 50), (31, 130), (200, 200)])
@pytest.mark.parametrize("radius", [50, 333])
def test_chunks_have_the_bits_of_the_whole(chunks, radius):
    names = ("svf", "openness", "horizon")
    whole = obscura.terrain(hills(), cell_size=10, radius=radius, datum=0, quantities=names)
    parts = obscura.dask.terrain(da.from_array(hills(), chunks=chunks), cell_size=10, radius=radius,
                                 quantities=names)
    for name in names:
        assert parts[name].shape == whole[name].shape
        assert (parts[name].compute(scheduler="threads") == whole[name]).all(), name


def test_cells_without_data_in_the_halo():
    h = hills()
    h[40:50, 60:70] = np.nan
    h[10, 10] = -9999
    whole = obscura.terrain(h, cell_size=10, radius=100, datum=0, nodata=-9999)
    part = obscura.dask.terrain(da.from_array(h, chunks=(45, 65)), cell_size=10, radius=100,
                                nodata=-9999).compute(scheduler="threads")
    assert np.array_equal(part, whole, equal_nan=True) and np.isnan(part).sum() == 101


def test_frames():
    frames = np.full((5, 20, 30), 5, np.float32)
    for i in range(5):
        frames[i, 8:14, 4 * i:4 * i + 8] = 4
    camera = obscura.Camera.perspective(fov_y_deg=50)
    stack = obscura.dask.visibility(da.from_array(frames, chunks=(2, -1, -1)), camera=camera,
                                    guard_band=2, radius=1)
    assert stack.shape == (5, 16, 26)
    found = stack.compute(scheduler="threads")
    for frame, v in zip(frames, found):
        assert (v == obscura.visibility(frame, camera=camera, guard_band=2, radius=1)).all()


@pytest.mark.parametrize("make, error, words", [
    (lambda a: obscura.dask.terrain(a, cell_size=1, radius=np.inf), ValueError, "radius is inf"),
    (lambda a: obscura.dask.terrain(a.astype(float), cell_size=1, radius=5), TypeError, "float64"),
    (lambda a: obscura.dask.visibility(a, camera=None), TypeError, r"\(N, H, W\)"),
    (lambda a: obscura.dask.visibility(a[None], camera=None), ValueError, "rechunk"),
])
def test_mistakes_are_named(make, error, words):
    with pytest.raises(error, match=words):
        make(da.from_array(hills(), chunks=45))


def test_a_killed_worker_loses_nothing():
    distributed = pytest.importorskip("distributed")
    h = hills(400, 400)
    whole = obscura.terrain(h, cell_size=10, radius=300, datum=0, azimuths=64)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                  dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        pids = list(client.run(os.getpid).values())
        assert len(set(pids)) == 2
        result = client.compute(obscura.dask.terrain(da.from_array(h, chunks=40), cell_size=10,
                                                     radius=300, azimuths=64))
        # In the middle: some chunks are done, others are not.
        while not (states := client.run_on_scheduler(
                lambda dask_scheduler: [t.state for t in dask_scheduler.tasks.values()])) or \
                states.count("memory") < 20:
            pass
        assert not result.done()
        os.kill(pids[0], signal.SIGKILL)
        assert (result.result(timeout=120) == whole).all()
