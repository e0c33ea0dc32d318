"""Builds the wheel of Quadrel by CMake: what pip asks of a project (PEP 517).

It needs no package but CMake, a compiler and what Quadrel is built of (.ci/packages); setuptools and
wheel are not. The build is kept in build/wheel of the project, a folder for each version of Python, so
that the next one is short. CMAKE_ARGS are more arguments for CMake, as CMAKE_ARGS="-D
QUADREL_ONLY_ISAS=avx2". With QUADREL_BUILD=FOLDER it is that of a configured build that is there
already.
"""

import base64
import hashlib
import os
import pathlib
import shlex
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def built():
    """A folder in which the target quadrel-python is built."""
    chosen = os.environ.get("QUADREL_BUILD")
    build = pathlib.Path(chosen) if chosen else PROJECT / "build" / "wheel" / sys.implementation.cache_tag
    if not chosen:
        off = [f"-DQUADREL_BUILD_{what}=OFF" for what in ("TESTS", "BENCH", "TOOLS")]
        run("cmake", "-S", PROJECT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DPython3_EXECUTABLE={sys.executable}", "-DQUADREL_BUILD_PYTHON=ON", *off,
            *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    run("cmake", "--build", build, "--target", "quadrel-python")
    return build


def metadata():
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {project['version']}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        *(f"Requires-Dist: {name}" for name in project["dependencies"]),
    ]
    return project, "\n".join(lines) + "\n"


def wheel_tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{version}-{version}-{platform}"


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def described():
    """The name and version of the project, and its files METADATA and WHEEL."""
    project, text = metadata()
    wheel = (f"Wheel-Version: 1.0\nGenerator: quadrel\nRoot-Is-Purelib: false\n"
             f"Tag: {wheel_tag()}\n")
    return f"{project['name']}-{project['version']}", {"METADATA": text, "WHEEL": wheel}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    stem, files = described()
    info = pathlib.Path(metadata_directory) / f"{stem}.dist-info"
    info.mkdir()
    for name, text in files.items():
        (info / name).write_text(text)
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    stem, files = described()
    info = f"{stem}.dist-info"
    name = f"{stem}-{wheel_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        run("cmake", "--install", built(), "--component", "wheel", "--strip", "--prefix", folder)
        contents = {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()
        }
    for file, text in files.items():
        contents[f"{info}/{file}"] = text.encode()
    record = "".join(record_line(*item) for item in contents.items()) + f"{info}/RECORD,,\n"
    contents[f"{info}/RECORD"] = record.encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in contents.items():
            archive.writestr(path, content)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("quadrel: a wheel is built from the whole project; there is no sdist")
