"""A wheel: `pip wheel --no-build-isolation bindings/python`. CMake builds the compiled parts, for
the Python that runs this; OBSCURA_BUILD_FOLDER names a build folder to take in place of a new one."""
import glob
import os
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def version():
    with open(os.path.join(ROOT, "include/obscura/version.h"), encoding="utf-8") as f:
        return ".".join(re.findall(r"#define OBSCURA_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", f.read()))


class CMakeBuild(build_ext):
    def run(self):
        folder = os.environ.get("OBSCURA_BUILD_FOLDER")
        if not folder:
            folder = os.path.abspath(self.build_temp)
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja",
                            "-DCMAKE_BUILD_TYPE=Release", "-DOBSCURA_BUILD_PYTHON=ON",
                            f"-DOBSCURA_PYTHON={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "obscura_python_package"], check=True)
        target = os.path.join(HERE if self.inplace else self.build_lib, "obscura")
        os.makedirs(target, exist_ok=True)
        for pattern in ("*.so", "*.pyi"):
            for path in glob.glob(os.path.join(folder, "python/obscura", pattern)):
                copy = shutil.copy(path, target)
                if pattern == "*.so":
                    subprocess.run(["strip", "--strip-unneeded", copy], check=True)


setup(
    name="obscura",
    version=version(),
    description="Ambient visibility of depth images, elevation models and volumes",
    license="see LICENSE",
    packages=["obscura"],
    package_data={"obscura": ["py.typed"]},
    ext_modules=[Extension("obscura._library", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    python_requires=">=3.9",
    install_requires=["numpy>=1.21"],
)
