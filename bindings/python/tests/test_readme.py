"""The lines of the README run as they stand."""
import os

import numpy as np
import pytest

import obscura

README = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../README.md")


def test_the_lines_of_the_readme(tmp_path, monkeypatch):
    pytest.importorskip("obscura._files")
    if not os.path.exists(README):
        pytest.skip("the repository is not around these tests")
    with open(README, encoding="utf-8") as f:
        lines = f.read().split("**In Python**")[1].split("\n\n")[1].splitlines()
    assert len(lines) == 3 and all(line.startswith("    ") for line in lines)
    monkeypatch.chdir(tmp_path)
    exec("\n".join(line[4:] for line in lines), {})
    (picture,) = obscura.read(tmp_path / "ao.png").values()
    assert picture.shape == (360, 640) and 0.5 < np.mean(picture) < 1
    (kept,) = obscura.read(os.path.join(os.path.dirname(README),
                                        "docs/images/python-hall.png")).values()
    assert np.abs(picture - kept).mean() < 0.005
