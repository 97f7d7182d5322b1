# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C ends every long call, with or without a progress function."""

import subprocess
import sys
import threading
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

# A torus so fine that each call takes seconds, and a signal in its midst: says how long after it the call ended.
PROGRAM = """
import signal, threading, time
import numpy as np
import mrcontour as mrc

along, around = 700, 300
u, v = np.meshgrid(2 * np.pi * np.arange(along) / along, 2 * np.pi * np.arange(around) / around, indexing="ij")
radius = 1 + 0.1 * np.cos(5 * u)
ring_radius = 3 + radius * np.cos(v)
points = np.stack([ring_radius * np.cos(u), ring_radius * np.sin(u), radius * np.sin(v)], axis=-1).reshape(-1, 3)
i, j = np.meshgrid(np.arange(along), np.arange(around), indexing="ij")
corner = lambda di, dj: ((i + di) % along) * around + (j + dj) % around
quads = np.stack([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)], axis=-1).reshape(-1, 4)
surface = mrc.Surface(points, np.arange(0, quads.size + 1, 4), quads.ravel())
rings = [k * around + np.arange(around) for k in (0, 300)]
whole = mrc.Options(width=None)
again = mrc.optimize(surface, rings[0]) if {again} else None
sent = []

def interrupt():
    time.sleep({delay})
    sent.append(time.perf_counter())
    signal.raise_signal(signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
try:
    while True:
        {call}
except KeyboardInterrupt:
    ended = time.perf_counter()
assert sent, "the call ended by itself"
assert {check}
print(ended - sent[0])
"""

CALLS = {
    "optimize": "mrc.optimize(surface, rings[0], options=whole)",
    "gates": "mrc.optimize(surface, rings[0], options=mrc.Options(width=None, flow='gates'))",
    "refined": "mrc.optimize(surface, rings[0], options=mrc.Options(width=60, refinement=2))",
    "optimize_all": "mrc.optimize_all(surface, rings, options=mrc.Options(width=None, threads=2))",
    "progress": "mrc.optimize(surface, rings[0], options=whole, progress=lambda share: True)",
    "curvature": "mrc.curvature(surface)",
    "close_contour": "mrc.close_contour(surface, np.arange(0, 250) * around)",
    "check_contour": "mrc.check_contour(surface, rings[0])",
    "band": "mrc.band(surface, rings[0], options=whole)",
    "measure": "mrc.measure(surface, rings[0])",
    "search_space": "mrc.search_space(surface, rings[0], options=whole)",
}


def seconds_to_end(call, delay, check="True", again=False):
    code = PROGRAM.replace("{call}", call).replace("{delay}", str(delay)).replace("{check}", check)
    code = code.replace("{again}", str(again))
    folder = str(Path(mrc.__file__).parent)
    run = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {folder!r})\n{code}"],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert run.returncode == 0, run.stderr
    return float(run.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("delay", [0.1, 1.0])
def test_a_signal_ends_a_call_soon(name, delay, record_property):
    seconds = seconds_to_end(CALLS[name], delay)
    record_property("seconds", seconds)
    assert seconds < 1.0  # 0.2 on a machine that does nothing else


@pytest.mark.slow
def test_a_surface_serves_on_after_an_interrupt():
    check = "np.array_equal(mrc.optimize(surface, rings[0]).vertices, again.vertices)"
    assert seconds_to_end(CALLS["optimize"], 0.6, check, again=True) < 1.0


def test_other_threads_search_without_signals():
    mesh = meshes.tube(1 + 0.1 * np.cos(np.arange(9)), 8)
    surface, ring, found = surface_of(mesh), 8 * 4 + np.arange(8), []
    thread = threading.Thread(target=lambda: found.append(mrc.optimize(surface, ring)))
    thread.start()
    thread.join()
    assert found[0].contour == mrc.optimize(surface, ring).contour
