# SPDX-License-Identifier: GPL-3.0-or-later
"""Cancelling at any moment leaks nothing, and leaves the surface and its arrays unchanged."""

import ctypes
import gc
import os

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of
from fingerprints import bytes_of

CANCELS = 1000 if os.environ.get("MRC_LONG") else 120  # in total, over all three kinds
WARM_UP = 60  # cancels until allocators and caches hold what they keep
ALLOWED = 64 * 1024  # bytes: more than noise, less than one search holds


class Stopped(Exception):
    pass


class AllocatedBytes(ctypes.Structure):
    """The struct mallinfo2 of glibc."""

    _fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks")] + [
        (name, ctypes.c_size_t) for name in ("fsmblks", "uordblks", "fordblks", "keepcost")
    ]


def allocated():
    """The bytes that malloc handed out and were not freed; 0 if the system does not tell."""
    try:
        ask = ctypes.CDLL(None).mallinfo2
    except (AttributeError, OSError, TypeError):
        return 0
    gc.collect()
    ask.restype = AllocatedBytes
    told = ask()
    return told.uordblks + told.hblkhd


MESH = meshes.torus(14, 60, rng=np.random.default_rng(5), split_fraction=0.5, noise=0.02, grooves=0.3)
RINGS = [60 * np.arange(14, dtype=np.int32) + column for column in (5, 20, 40)]
OPTIONS = {"width": 5, "refinement": 1, "iterations": 3, "regular_iterations": 1}


def one(surface, threads, progress):
    return [mrc.optimize(surface, RINGS[0], options=mrc.Options(**OPTIONS, threads=threads), progress=progress)]


def several(surface, threads, progress):
    return mrc.optimize_all(surface, RINGS, options=mrc.Options(**OPTIONS, threads=threads), progress=progress)


def closing(surface, threads, progress):
    """On enough vertices for progress to be called."""
    loop = mrc.close_contour(surface, RINGS[0][:5], progress=progress)
    return [] if loop is None else one(surface, threads, None)


CALLS = (one, several, closing)


class Canceller:
    """Cancels at the n-th call, by its return value or by an exception."""

    def __init__(self, at, by_exception):
        self.at, self.by_exception, self.heard = at, by_exception, 0

    def __call__(self, fraction):
        self.heard += 1
        if self.heard == self.at and self.by_exception:
            raise Stopped
        return self.heard != self.at


def count_calls(call, surface):
    listener = Canceller(0, False)
    call(surface, 1, listener)
    return listener.heard


def cancel_once(rng, surface, call, longest):
    """Cancels at a random call of progress. Returns whether that ended the work."""
    canceller = Canceller(int(rng.integers(1, longest + 1)), bool(rng.integers(2)))
    threads = int(rng.choice([1, 2, 3]))
    try:
        results = call(surface, threads, canceller)
    except Stopped:
        assert canceller.by_exception
        return True
    cancelled = [result.status == "cancelled" for result in results]
    assert all(cancelled) or not any(cancelled)
    for result, ring in zip(results, RINGS if all(cancelled) else (), strict=False):
        assert result.vertices.tolist() == ring.tolist()
    return all(cancelled)


def test_cancelling_at_a_random_moment_leaks_nothing_and_keeps_the_mesh():
    rng = np.random.default_rng(11)
    arrays = [np.array(part) for part in MESH.arguments()]
    surface = mrc.Surface(*arrays)
    before = {call: list(map(bytes_of, call(surface, 1, None))) for call in CALLS}
    longest = {call: count_calls(call, surface) for call in CALLS}
    ended, held = 0, 0
    for number in range(WARM_UP + CANCELS):
        if number == WARM_UP:
            held = allocated()
        call = CALLS[number % len(CALLS)]
        ended += cancel_once(rng, surface, call, longest[call])
    leaked = allocated() - held
    assert ended > 0.5 * CANCELS
    assert leaked < ALLOWED, f"{leaked} bytes after {CANCELS} cancels"
    for array, given in zip(arrays, MESH.arguments(), strict=True):
        assert array.tobytes() == given.tobytes()
    for call in CALLS:
        assert list(map(bytes_of, call(surface, 1, None))) == before[call]
        assert list(map(bytes_of, call(surface_of(MESH), 3, None))) == before[call]


def test_leak_measurement_sees_memory_that_is_kept():
    """Otherwise the measurement above would prove nothing."""
    held = allocated()
    if not held:
        pytest.skip("the allocator does not tell")
    kept = [surface_of(meshes.tube([1.0, 1.1, 1.0], 8)) for _ in range(CANCELS)]
    assert allocated() - held > ALLOWED
    del kept
    assert allocated() - held < ALLOWED
