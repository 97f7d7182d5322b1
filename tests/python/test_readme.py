# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's Python examples do what they say."""

import re
from pathlib import Path

import numpy as np

README = Path(__file__).resolve().parents[2] / "README.md"


def examples():
    return re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)


def test_the_example_for_the_module_finds_the_waist():
    (code,) = (code for code in examples() if "import mrcontour" in code)
    names = {}
    exec(compile(code, "README.md", "exec"), names)  # noqa: S102
    assert names["result"].status == "improved"
    assert np.allclose(names["result"].positions[:, 2], 0.2)
