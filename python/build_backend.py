"""The build backend of pip: CMake builds and installs the package, and this module packs a wheel.
It needs the packages of tools/setup --python, and no Python packages.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
VERSION = re.search(r"^project\(vcarve VERSION ([0-9.]+)",
                    (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]
METADATA = f"""Metadata-Version: 2.1
Name: vcarve
Version: {VERSION}
Summary: Surfaces of COLMAP models and of points whose views are known
License: GPL-3.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
"""
EARLIEST = (1980, 1, 1, 0, 0, 0)  # earliest date of zip files; makes equal builds byte-identical


def _tag(platform):
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{re.sub('[-.]', '_', platform)}"


def _install(prefix):
    """Builds the package in build-wheel/, incrementally, and installs it."""
    build = ROOT / "build-wheel"
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DVCARVE_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
                    "-DVCARVE_PYTHON_DIR=.", "-DVCARVE_PROGRAM=OFF", "-DVCARVE_TESTS=OFF",
                    "-DVCARVE_BENCHMARKS=OFF", "-DVCARVE_LAB=OFF"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "vcarve_python"], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix,
                    "--strip"], check=True)


def _record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def pack(prefix, wheel_directory, platform):
    """Packs all files below a folder into a wheel; returns its name."""
    tag = _tag(platform)
    info = f"vcarve-{VERSION}.dist-info"
    contents = {f"{info}/METADATA": METADATA.encode(),
                f"{info}/WHEEL": (f"Wheel-Version: 1.0\nGenerator: vcarve\n"
                                  f"Root-Is-Purelib: false\nTag: {tag}\n").encode(),
                f"{info}/LICENSE": (ROOT / "LICENSE").read_bytes()}
    for file in sorted(pathlib.Path(prefix).rglob("*")):
        if file.is_file():
            contents[file.relative_to(prefix).as_posix()] = file.read_bytes()
    lines = [_record_line(name, content) for name, content in contents.items()]
    contents[f"{info}/RECORD"] = "".join([*lines, f"{info}/RECORD,,\n"]).encode()
    name = f"vcarve-{VERSION}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in contents.items():
            entry = zipfile.ZipInfo(path, EARLIEST)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds a wheel (PEP 517). Returns its name."""
    del config_settings, metadata_directory
    with tempfile.TemporaryDirectory() as prefix:
        _install(prefix)
        return pack(prefix, wheel_directory, sysconfig.get_platform())


if __name__ == "__main__":
    print(pack(*sys.argv[1:]))  # tools/package: FOLDER OUT PLATFORM
