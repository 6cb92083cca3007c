"""The notebooks of docs/notebooks run, and are kept without their outputs."""
import json
import os
import subprocess
import sys

import pytest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))
NOTEBOOKS = os.path.join(ROOT, "docs/notebooks")
if not os.path.isdir(NOTEBOOKS):
    pytest.skip("the repository is not around these tests", allow_module_level=True)
NAMES = sorted(n[:-6] for n in os.listdir(NOTEBOOKS) if n.endswith(".ipynb"))


@pytest.mark.parametrize("name", NAMES)
def test_kept_without_outputs(name):
    path = os.path.join(NOTEBOOKS, name + ".ipynb")
    assert os.path.getsize(path) < 500_000
    with open(path, encoding="utf-8") as f:
        for cell in json.load(f)["cells"]:
            assert not cell.get("outputs") and not cell.get("execution_count")


@pytest.mark.parametrize("name", NAMES)
def test_runs_and_shows_pictures(name, tmp_path):
    for module in ("nbclient", "ipykernel", "matplotlib", "obscura._files"):
        pytest.importorskip(module)
    subprocess.run([sys.executable, os.path.join(ROOT, "tools/notebooks.py"), str(tmp_path), name,
                    "--small"], check=True, timeout=200)
    with open(tmp_path / (name + ".ipynb"), encoding="utf-8") as f:
        cells = json.load(f)["cells"]
    pictures = [o for c in cells for o in c.get("outputs", []) if "image/png" in o.get("data", {})]
    assert pictures and all(len(o["data"]["image/png"]) > 5000 for o in pictures)
