"""Runs the notebooks of docs/notebooks and writes them with their pictures:

    notebooks.py FOLDER [NAME...] [--small]

--small: at the sizes of SMALL, for tests.
"""
import argparse
import glob
import os

import nbclient
import nbformat

SOURCES = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "docs/notebooks")
# In place of the cell with the tag "parameters".
SMALL = {"depth": "shape = (90, 160)\nrays = 16",
         "mesh": "segments = 60\nrays = 32",
         "volume": 'path = "volume:vessels?size=40"\nisovalue = None\nshape = (60, 60)',
         "terrain": "cells = 64\ncell_size = 10.0"}


def run(name, folder, small):
    notebook = nbformat.read(os.path.join(SOURCES, name + ".ipynb"), as_version=4)
    if small:
        cell = next(c for c in notebook.cells if "parameters" in c.metadata.get("tags", []))
        cell.source = SMALL[name]
    nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": folder}}).execute()
    path = os.path.join(folder, name + ".ipynb")
    nbformat.write(notebook, path)
    return path


def names():
    return sorted(os.path.splitext(os.path.basename(p))[0]
                  for p in glob.glob(os.path.join(SOURCES, "*.ipynb")))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--small", action="store_true")
    options = parser.parse_args()
    # Kernels have another working folder, and need no debugger.
    paths = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    os.environ["PYTHONPATH"] = os.pathsep.join(os.path.abspath(p) for p in paths if p)
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    os.makedirs(options.folder, exist_ok=True)
    for each in options.names or names():
        print(run(each, options.folder, options.small), flush=True)
