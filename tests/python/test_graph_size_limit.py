# SPDX-License-Identifier: GPL-3.0-or-later
"""A search that needs more memory than is free, or more arcs than can be numbered, is refused before it takes
memory."""

import re
import sys
from pathlib import Path

import meshes
import mrcontour as mrc
import numpy as np
import pytest
from conftest import surface_of

MOST_ARCS = 2**31
RING = np.arange(16, 24, dtype=np.int32)


@pytest.fixture(scope="module")
def surface():
    return surface_of(meshes.tube(1 + 0.1 * np.cos(np.arange(6)), 8, rng=np.random.default_rng(2), noise=0.02))


def estimate(error):
    """The nodes, arcs and bytes in a message, which also says what to lower."""
    found = re.search(
        r"about (\S+) nodes and (\S+) arcs and need (\S+) GB: lower refinement \(now (\d+)\) or width", error
    )
    assert found, error
    nodes, arcs, gigabytes = map(float, found.groups()[:3])
    return nodes, arcs, 1e9 * gigabytes


def most_memory():
    """The peak memory of this process, in kilobytes. Only on Linux: macOS counts bytes, and Windows does not tell."""
    if sys.platform != "linux":
        return 0
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def refused(call):
    """Checks that a search is refused without taking much memory. Returns the estimate in the message."""
    before = most_memory()
    with pytest.raises(mrc.TooLarge) as caught:
        call()
    assert most_memory() - before < 200_000
    return estimate(str(caught.value)), str(caught.value)


@pytest.mark.parametrize("k", [100_000, 2**31 - 1])
@pytest.mark.parametrize("function", [mrc.optimize, mrc.measure, mrc.search_space])
def test_too_many_arcs_of_the_contour_alone_are_refused(surface, function, k):
    (_, arcs, size), message = refused(lambda: function(surface, RING, options=mrc.Options(refinement=k)))
    assert arcs > MOST_ARCS
    assert size > 24 * MOST_ARCS
    assert f"now {k}" in message


def test_error_names_the_contour_that_is_too_large(surface):
    rings = [RING, RING + 16]
    _, message = refused(lambda: mrc.optimize_all(surface, rings, options=mrc.Options(refinement=100_000)))
    assert message.startswith("contour 0: ")


@pytest.mark.parametrize("iterations", [{"iterations": 1}, {"iterations": 0, "regular_iterations": 1}])
def test_only_bands_searched_with_refinement_count(iterations):
    """A refinement that is fine for a narrow band is refused for a wide one, if any iteration uses it."""
    torus, ring = surface_of(meshes.torus(60, 120)), 120 * np.arange(60, dtype=np.int32)
    options = mrc.Options(refinement=40, width=100, flow="arc_length", **iterations)
    if options.iterations:
        (nodes, arcs, _), _ = refused(lambda: mrc.optimize(torus, ring, options=options))
        assert nodes > 14_000 * 3 * 40**2
        assert arcs > MOST_ARCS
    else:
        assert mrc.optimize(torus, ring, options=options).status in ("improved", "unchanged")


def free_bytes():
    """The free memory according to Linux."""
    path = Path("/proc/meminfo")
    if not path.exists():
        pytest.skip("free memory is read the way Linux reports it")
    return 1024 * int(re.search(r"MemAvailable: *(\d+)", path.read_text())[1])


def test_limit_is_the_free_memory_or_the_maximum_number_of_arcs(surface):
    """Found by bisection, with searches that only estimate and build no graph."""
    fine, too_many, message = 1, 100_000, ""
    while too_many - fine > 1 + fine // 100:
        k = (fine + too_many) // 2
        try:
            mrc.measure(surface, RING, options=mrc.Options(refinement=k))
            fine = k
        except mrc.TooLarge as error:
            too_many, message = k, str(error)
    _, arcs, size = estimate(message)
    assert size == pytest.approx(free_bytes(), rel=0.4) or arcs == pytest.approx(MOST_ARCS, rel=0.1)
