# SPDX-License-Identifier: GPL-3.0-or-later
"""Type checkers understand the installed module through the stubs in the wheel."""

import re
import subprocess
import sys
import sysconfig
import venv
from zipfile import ZipFile

import pytest
from conftest import ROOT, only


@pytest.fixture(scope="module")
def python(own_packages, tmp_path_factory):
    """A Python with the wheel installed, in addition to the packages of this one."""
    folder = tmp_path_factory.mktemp("installed")
    venv.create(folder, with_pip=False)
    site = only(folder.glob("lib/python*/site-packages"))
    with ZipFile(own_packages["wheel"]) as content:
        content.extractall(site)
    (site / "others.pth").write_text(sysconfig.get_path("platlib"), encoding="utf-8")
    return folder / "bin" / "python"


def example():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    return only(code for code in re.findall(r"```python\n(.*?)```", readme, re.DOTALL) if "import mrcontour" in code)


def checked(python, folder, code):
    """The output of mypy for a piece of code, in strict mode."""
    file = folder / "example.py"
    file.write_text(code, encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", "--python-executable", str(python), "--cache-dir", str(folder)]
    return subprocess.run([*command, file.name], capture_output=True, text=True, cwd=folder).stdout


MISTAKES = {
    "mrc.Options(widht=3)": 'error: Unexpected keyword argument "widht"',
    "mrc.Options(flow='straight')": "expected \"Literal['gates', 'arc_length', 'harmonic']\"",
    "mrc.Options().width + 1": 'error: Unsupported operand types for + ("None" and "int")',
    "mrc.optimize(ring, surface)": 'expected "Surface"',
    "result.position": 'error: "Result" has no attribute "position"',
    "len(result.scales.h)": 'expected "Sized"',
    "result.status == 'improve'": "error: Non-overlapping equality check",
    "result.reason_code == 'best'": "error: Non-overlapping equality check",
}
RIGHT = """
plain: mrc.Result = mrc.optimize(surface, ring, scales=None, options=mrc.Options(width=None))
places: np.typing.NDArray[np.float64] = plain.positions
version: str = mrc.__version__
"""


def test_correct_code_has_no_type_errors(python, tmp_path):
    assert "Success" in checked(python, tmp_path, example() + RIGHT)


def test_type_errors_are_found_at_their_lines(python, tmp_path):
    first = 1 + example().count("\n")
    found = checked(python, tmp_path, example() + "\n".join(MISTAKES)).splitlines()
    for number, wanted in enumerate(MISTAKES.values(), first):
        assert any(line.startswith(f"example.py:{number}:") and wanted in line for line in found), (wanted, found)
    wrong = {int(line.split(":")[1]) for line in found if " error: " in line}
    assert wrong == set(range(first, first + len(MISTAKES)))


def test_example_runs_with_the_wheel(python, tmp_path):
    run = subprocess.run([python, "-c", example()], capture_output=True, text=True, cwd=tmp_path)
    assert run.stdout.startswith("improved"), run.stderr
