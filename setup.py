# SPDX-License-Identifier: BSD-3-Clause
"""The Python package by setuptools, built by the same CMakeLists as everything else."""

import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
PACKAGE = "modules/python/edgevo"


def version() -> str:
    found = re.search(r"project\(edgevo VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found
    return found.group(1)


def data_files() -> list[tuple[str, list[str]]]:
    """What the library looks for in PREFIX/share/edgevo: models of detectors, scenes."""
    folders = {"share/models": "models", "datasets/scenes": "datasets/scenes"}
    return [
        (f"share/edgevo/{to}", sorted(str(f.relative_to(ROOT)) for f in (ROOT / folder).iterdir() if f.is_file()))
        for folder, to in folders.items()
    ]


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        build = pathlib.Path(self.build_temp).resolve()
        subprocess.run(
            [str(ROOT / "share/configure.sh"), str(build), "-DCMAKE_BUILD_TYPE=Release", "-DEDGEVO_BUILD_MODULES=python",
             "-DEDGEVO_BUILD_TESTS=OFF", "-DEDGEVO_SCENES_OF_SOURCES=OFF", f"-DPython_EXECUTABLE={sys.executable}",
             f"-DCMAKE_INSTALL_PREFIX={sys.prefix}"], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "edgevo_py"], check=True)
        built = next((build / "python/edgevo").glob("_edgevo.*.so"))
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


setup(
    version=version(),
    packages=["edgevo"],
    package_dir={"edgevo": PACKAGE},
    package_data={"edgevo": ["py.typed", "*.pyi"]},
    data_files=data_files(),
    ext_modules=[Extension("edgevo._edgevo", [])],
    cmdclass={"build_ext": BuildByCMake},
    zip_safe=False,
)
