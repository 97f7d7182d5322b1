# SPDX-License-Identifier: GPL-3.0-or-later
"""The same input gives the same bytes on every machine."""

import ctypes
import re
import shutil
import subprocess
import sys
from pathlib import Path

import fingerprints
import mrcontour as mrc
import pytest

FOLDER = Path(__file__).parent
EXPECTED = (FOLDER / "stored_searches.txt").read_text().splitlines()
ROOT = FOLDER.parents[1]
# IEEE 754 leaves no choice in these. All others of the C library differ between systems, versions and processors.
EXACT = {"ceil", "ceilf", "fabs", "floor", "llround", "lround", "rint", "round", "sqrt", "trunc"}
UNCALLED = {"cos"}  # by OpenMesh, for normals at creases
INEXACT = re.compile(
    r"(?<!elementary::)\b(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(10|2|1p)?|pow|hypot|cbrt|[lt]gamma|erfc?|fma)\("
)


def symbols(kind, file):
    names = subprocess.run(["nm", "-D", kind, file], check=True, capture_output=True, text=True).stdout
    return {line.split()[-1].partition("@")[0] for line in names.splitlines()}


@pytest.mark.skipif(sys.platform != "linux" or not shutil.which("nm"), reason="reads Linux's libraries with nm")
def test_no_function_of_the_systems_mathematics_decides_results():
    ctypes.CDLL("libm.so.6")
    library = next(line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if "libm.so" in line)
    used = symbols("--undefined-only", mrc.__file__) & symbols("--defined-only", library)
    assert used <= EXACT | UNCALLED


def test_no_code_calls_inexact_functions():
    sources = [path for folder in ("include", "python", "src") for path in (ROOT / "native" / folder).rglob("*.[ch]*")]
    own = [path for path in sources if path.stem != "elementary_functions"]
    assert len(own) > 100
    code = {path.name: re.sub("//.*", "", path.read_text(encoding="utf-8")) for path in own}
    assert [name for name, text in code.items() if INEXACT.search(text)] == []


@pytest.fixture(scope="module")
def searches():
    return fingerprints.read(FOLDER / "stored_searches.json.xz")


@pytest.mark.parametrize("number", range(len(EXPECTED)))
def test_stored_searches_give_these_bytes_on_every_machine(searches, number):
    """Where results change on purpose, `fingerprints.py stored_searches.json.xz` writes the expected lines anew."""
    assert fingerprints.line(searches[number]) == EXPECTED[number]


def test_all_stored_searches_are_expected(searches):
    assert [line.split()[0] for line in EXPECTED] == [search["name"] for search in searches]
