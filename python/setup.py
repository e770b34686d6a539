"""Builds the extension with CMake, as the program is built."""

import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent
VERSION = re.search(r"project\(koshi VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DKOSHI_TESTS=OFF", f"-DKOSHI_PYTHON={sys.executable}"]
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, *options, "-DKOSHI_PYTHON_MODULE=ON"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "_koshi"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(next((build / "python" / "koshi").glob("_koshi*.so")), target)


setup(version=VERSION, ext_modules=[Extension("koshi._koshi", sources=[])], cmdclass={"build_ext": CMakeBuild})
