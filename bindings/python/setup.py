"""Builds the package with CMake: what `pip install .` runs in this folder, offline with the system's tools."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

FOLDER = pathlib.Path(__file__).resolve().parent
PROJECT = FOLDER.parent.parent


class CMakeBuild(build_ext):
    """Configures and builds the one target, into the place where setuptools looks for the extension.

    TACT_CMAKE_OPTIONS has more options for CMake, as a shell would read them.
    """

    def build_extension(self, extension):
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        build = pathlib.Path(self.build_temp).resolve()
        options = [
            "-DCMAKE_BUILD_TYPE=Release",
            "-DTACT_BUILD_PYTHON=ON",
            "-DTACT_UNITY_BUILD=ON",
            f"-DPython3_EXECUTABLE={sys.executable}",
        ]
        options += shlex.split(os.environ.get("TACT_CMAKE_OPTIONS", ""))
        if shutil.which("ninja"):  # a machine with Ninja need not have make
            options += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", PROJECT, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "tact_python", *self.jobs()], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        for module in (build / "bindings/python/tact").glob("_tact.*.so"):
            self.copy_file(str(module), str(target))  # under the name that this Python has for it

    def jobs(self):
        """As many compilers at a time as build_ext --parallel says, or CMAKE_BUILD_PARALLEL_LEVEL, else as cmake likes."""
        if self.parallel is not None:
            return ["--parallel", str(self.parallel)]
        return [] if os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") else ["--parallel"]


def version():
    text = (PROJECT / "engine/include/tact/version.h").read_text()
    return re.search(r'define TACT_VERSION "(.*)"', text).group(1)


setup(
    name="tact",
    version=version(),
    description="Finds where many deformable bodies touch",
    license="MIT",
    packages=["tact"],
    package_data={"tact": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("tact._tact", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    python_requires=">=3.9",
    install_requires=["numpy"],
    zip_safe=False,
)
