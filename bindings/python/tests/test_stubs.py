"""The stubs: as the functions are, and of use to mypy."""
import ast
import inspect
import os
import subprocess
import sys

import pytest

import obscura

STUBS = os.path.join(os.path.dirname(obscura.__file__), "__init__.pyi")


def functions(body):
    for node in body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, [a.arg for a in node.args.posonlyargs + node.args.args +
                              node.args.kwonlyargs]


@pytest.fixture(scope="module")
def tree():
    pytest.importorskip("obscura._files")
    with open(STUBS, encoding="utf-8") as f:
        return ast.parse(f.read())


def test_every_name_has_its_stub(tree):
    names = {n.name for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
    assert names == set(obscura.__all__)


def test_parameters_are_those_of_the_functions(tree):
    checked = 0
    classes = [(obscura, tree.body)] + [(getattr(obscura, n.name), n.body) for n in tree.body
                                        if isinstance(n, ast.ClassDef)]
    for owner, body in classes:
        for name, in_stub in functions(body):
            signature = inspect.signature(getattr(owner, name)).parameters
            own = [p.name for p in signature.values() if p.kind != p.VAR_KEYWORD]
            assert set(own) <= set(in_stub), (name, set(own) - set(in_stub))
            if len(own) == len(signature):
                assert set(own) == set(in_stub), name
            checked += 1
    assert checked > 40


def test_every_setting_of_every_method_is_there(tree):
    overloads = [n for n in tree.body if isinstance(n, ast.FunctionDef) and n.name == "visibility"]
    found = {}
    for node in overloads:
        arguments = {a.arg: a.annotation for a in node.args.kwonlyargs}
        found[arguments["method"].slice.value] = set(arguments)
    assert set(found) == set(obscura.methods())
    for method, arguments in found.items():
        assert set(obscura.settings(method)) <= arguments


GOOD = """
import numpy as np
import obscura
depth = np.ones((4, 5), np.float32)
camera = obscura.Camera.perspective(fov_y_deg=50)
obscura.visibility(depth, camera=camera, radius=2, threads=1)
obscura.visibility(depth, camera=camera, method="horizon", radius=2.5, outputs=("visibility",))
obscura.Estimator("line", shape=depth.shape, radius=1).run(depth, camera=camera, progress=True)
field = obscura.sweep_occlusion(obscura.sweep_distance(np.ones((3, 3, 3), np.uint8), isovalue=1))
print(field.mean().dtype, obscura.compare(depth, depth).e_a + 1)
"""
BAD = ['obscura.visibility(depth, camera=camera, radios=2)',
       'obscura.visibility(depth, camera=camera, radius="wide"+1)',
       'obscura.visibility(depth, camera=camera, method="horizn")',
       'obscura.visibility(depth, camera=50)',
       'obscura.sweep_distance(depth)',
       'obscura.sweep_occlusion(depth, transport="fastest")',
       'obscura.terrain(depth, azimuths="many")']


def test_mypy_takes_what_is_right_and_nothing_else(tmp_path):
    pytest.importorskip("mypy")
    program = tmp_path / "program.py"
    good = GOOD.count("\n")
    program.write_text(GOOD + "\n".join(BAD) + "\n", encoding="utf-8")
    # mypy finds what is installed by itself, and refuses to be told of it.
    folder = os.path.dirname(os.path.dirname(obscura.__file__))
    where = {} if folder.endswith("-packages") else {"MYPYPATH": folder}
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary",
                          "--cache-dir", str(tmp_path / "cache"), str(program)],
                         capture_output=True, text=True, cwd=tmp_path, timeout=200, check=False,
                         env={**os.environ, **where})
    lines = {int(line.split(":")[1]) for line in run.stdout.splitlines() if ": error:" in line}
    assert lines == set(range(good + 1, good + 1 + len(BAD))), run.stdout + run.stderr
