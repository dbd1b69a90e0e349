"""Builds the package with scikit-build; name, version and the like come from here."""

import re
import shutil
import sys
from pathlib import Path
from typing import Any

from setuptools.command.sdist import sdist
from skbuild import setup

here = Path(__file__).resolve().parent
library = here / "library" if (here / "library").exists() else here.parent
version, address = re.search(
    r'project\(kinesphere VERSION ([\d.]+) .*HOMEPAGE_URL "(.*)"', (library / "CMakeLists.txt").read_text()
).groups()


class SourceDistribution(sdist):
    """Takes the library's sources along, so that the package can be built from them alone."""

    def make_release_tree(self, base_dir: str, files: Any) -> None:
        super().make_release_tree(base_dir, files)
        for part in ["include", "src", "toolkit", "simulation", "cmake", "CMakeLists.txt", "LICENSE"]:
            target = Path(base_dir) / "library" / part
            if (library / part).is_dir():
                shutil.copytree(library / part, target)
            else:
                target.parent.mkdir(exist_ok=True)
                shutil.copy(library / part, target)


setup(
    name="kinesphere",
    version=version,
    description="Finds every collision among moving spheres whose trajectories nobody knows in advance",
    long_description=(here / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    url=address or None,
    python_requires=">=3.11",
    install_requires=["numpy>=1.24"],
    extras_require={"pandas": ["pandas"], "plot": ["matplotlib"], "examples": ["matplotlib", "scipy"]},
    packages=["kinesphere"],
    package_data={"kinesphere": ["py.typed", "*.pyi"]},
    include_package_data=False,
    cmake_args=["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"],
    cmdclass={"sdist": SourceDistribution},
    zip_safe=False,
)
