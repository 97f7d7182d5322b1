# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect of keys on the settings of the modal operator, and the previews that it shows, without Blender."""

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import mrcontour as mrc
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
preview_state = importlib.import_module("addon.core.preview_state")
parameters = importlib.import_module("addon.core.parameters")
preview = importlib.import_module("addon.core.preview")

DEFAULTS = {name: row["default"] for name, row in parameters.SETTINGS.items()}
COMMANDS = sorted(preview_state._CHANGES)
KEYS = [*preview_state._PLAIN, *preview_state._SHIFTED]


def start(**settings):
    return preview_state.State.start(DEFAULTS | settings, "SELECT")


def after(state, *commands):
    for command in commands:
        state = preview_state.changed(state, command)
    return state


@given(st.lists(st.sampled_from(COMMANDS), max_size=60))
def test_no_key_makes_the_settings_invalid(commands):
    state = after(start(), *commands)
    mrc.Options(**parameters.native_options(**state.settings))
    assert state.output in preview_state.OUTPUTS


@pytest.mark.parametrize("command", COMMANDS)
def test_no_command_is_dead(command):
    state = preview_state.State.start(DEFAULTS | {"refinement": 1}, "SEAM", [(0, 5)])
    assert after(state, command) != state


@pytest.mark.parametrize(
    ("there", "back"),
    [("WIDER", "NARROWER"), ("FINER", "COARSER"), ("SHORTER", "LONGER"), ("NEXT_OUTPUT", "LAST_OUTPUT")]
    + [(command, command) for command in ("REACH", "WHOLE_SURFACE")],
)
def test_every_step_can_be_reverted(there, back):
    state = start(reach=0.3)
    assert after(state, there, back) == state


@pytest.mark.parametrize(
    ("command", "name"), [("NARROWER", "width"), ("COARSER", "refinement"), ("LONGER", "length_bias")]
)
def test_steps_end_where_the_settings_do(command, name):
    state = after(start(), *[command] * 100)
    assert state.settings[name] == parameters.SETTINGS[name]["min"]
    assert after(state, command) is state


def test_a_value_beyond_the_soft_limit_stays_within_reach():
    state = start(length_bias=50.0)
    assert after(state, "SHORTER") is state
    assert after(state, "LONGER").settings["length_bias"] == 49.5


def test_the_wheel_leaves_the_whole_surface():
    state = after(start(whole_surface=True), "WIDER")
    assert not state.settings["whole_surface"]
    assert state.settings["width"] == DEFAULTS["width"]


def test_outputs_wrap_around():
    assert after(start(), *["NEXT_OUTPUT"] * len(preview_state.OUTPUTS)) == start()


def test_every_command_has_a_key():
    reached = {preview_state.command_of(key, shift=shift) for key in KEYS for shift in (False, True)}
    assert reached >= {*COMMANDS, preview_state.CONFIRM, preview_state.CANCEL, preview_state.PIN}


@pytest.mark.parametrize("key", KEYS)
def test_with_ctrl_or_alt_keys_mean_something_else(key):
    for modifier in ("ctrl", "alt"):
        command = preview_state.command_of(key, **{modifier: True})
        assert command == (preview_state.PASS if "WHEEL" in key and modifier == "ctrl" else preview_state.IGNORE)


@pytest.mark.parametrize("key", ["MIDDLEMOUSE", "NUMPAD_1", "NUMPAD_PLUS", "TRACKPADPAN", "NDOF_MOTION", "TIMER"])
def test_the_view_can_be_moved(key):
    assert preview_state.command_of(key) == preview_state.PASS


@pytest.mark.parametrize("key", ["A", "TAB", "NUMPAD_SLASH", "MOUSEMOVE"])
def test_other_keys_do_nothing(key):
    assert preview_state.command_of(key) == preview_state.IGNORE


def test_keys_that_select_with_ctrl_are_not_passed_on():
    assert preview_state.command_of("NUMPAD_PLUS", ctrl=True) == preview_state.IGNORE
    assert preview_state.command_of("NUMPAD_0", ctrl=True) == preview_state.IGNORE


def test_a_second_click_unpins():
    state = start().toggled(0, 7).toggled(1, 3)
    assert state.pins_of(0) == [7]
    assert state.pins_of(1) == [3]
    assert state.toggled(0, 7).pins == {(1, 3)}
    assert state.toggled(1, 7).pins == {(1, 3)}  # where bands overlap another contour may be nearer now
    assert after(state, "UNPIN_ALL").pins == frozenset()


def test_the_header_says_what_the_keys_change():
    line = preview_state.header(start(width=5, refinement=2).toggled(0, 7), "Seam", "found")
    for text in ("Width: 5", "Refinement: 2", "Output: Seam", "Pins: 1", "found"):
        assert text in line
    assert "Whole Surface" in preview_state.header(after(start(), "WHOLE_SURFACE"), "Seam", "")


@pytest.mark.parametrize(
    ("commands", "wider"),
    [(["WIDER"], True), (["NARROWER"], False), (["FINER"], False), (["REACH", "WIDER"], False)],
)
def test_the_reach_can_limit_only_a_wider_band(commands, wider):
    before = state = start(width=5)
    for command in commands:
        before, state = state, preview_state.changed(state, command)
    assert preview_state.is_wider(state, before) == wider
    held = preview_state.header(state, "Seam", "", held=True)
    assert held.count("(E: off)") == 1 + preview_state.header(state, "Seam", "").count("(E: off)")


SEGMENTS, RINGS, GROOVE = 24, 17, 10


def cylinder():
    """Make the arrays of an open grooved cylinder around the z axis; rows of quads and of triangles alternate."""
    rows, angles = np.arange(RINGS), 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    radii = 1 - 0.3 * np.exp(-((rows - GROOVE) ** 2) / 2)
    points = [(r * np.cos(a), r * np.sin(a), 0.25 * row) for row, r in zip(rows, radii) for a in angles]
    faces, triangles = [], []
    for row in range(RINGS - 1):
        for column in range(SEGMENTS):
            low, next_low = row * SEGMENTS + column, row * SEGMENTS + (column + 1) % SEGMENTS
            halves = [[low, next_low, next_low + SEGMENTS], [low, next_low + SEGMENTS, low + SEGMENTS]]
            faces += halves if row % 2 else [[low, next_low, next_low + SEGMENTS, low + SEGMENTS]]
            triangles += halves
    return SimpleNamespace(
        positions=np.array(points),
        face_offsets=np.cumsum([0] + [len(face) for face in faces]).astype(np.int32),
        face_vertices=np.concatenate(faces).astype(np.int32),
        triangles=np.array(triangles, dtype=np.int32),
        hidden_faces=np.empty(0, dtype=np.int32),
    )


def ring(row):
    return np.arange(row * SEGMENTS, (row + 1) * SEGMENTS)


def made(*rows):
    """Make a preview of rings of the cylinder."""
    arrays = cylinder()
    outcomes = [SimpleNamespace(vertices=ring(row), closed=True, result=None) for row in rows]
    return preview.Preview(arrays, mrc.Surface(**vars(arrays)), outcomes)


def corners(arrays, face):
    return arrays.face_vertices[arrays.face_offsets[face] : arrays.face_offsets[face + 1]]


@pytest.mark.parametrize("state", [start(width=1), start(width=6, reach=0.0), start(refinement=2)])
def test_a_search_is_the_native_one(state):
    shown = made(GROOVE - 3)
    shown.search(state)
    options = mrc.Options(**parameters.native_options(**state.settings))
    (expected,) = mrc.optimize_all(shown.surface, [ring(GROOVE - 3)], options=options)
    assert np.array_equal(shown.outcomes[0].result.positions, expected.positions)
    assert np.array_equal(shown.bands[0], mrc.band(shown.surface, ring(GROOVE - 3), options=options))


def test_what_is_drawn_is_the_band_and_the_contours():
    shown, state = made(GROOVE - 3), start(width=3, reach=0.0).toggled(0, (GROOVE - 1) * SEGMENTS)
    shown.search(state)
    shapes, arrays = shown.shapes(state), shown.arrays
    counts = [len(corners(arrays, face)) - 2 for face in shown.bands[0]]
    assert 0 < len(counts) < len(arrays.face_offsets) - 1
    assert len(shapes.band) == 3 * sum(counts)
    used = np.unique(np.concatenate([corners(arrays, face) for face in shown.bands[0]]))
    drawn = np.unique(shapes.band, axis=0)
    assert np.array_equal(drawn, np.unique(arrays.positions[used].astype(np.float32), axis=0))
    for segments, points in (
        (shapes.given, arrays.positions[ring(GROOVE - 3)]),
        (shapes.found, shown.outcomes[0].result.positions),
    ):
        expected = np.stack([points, np.roll(points, -1, axis=0)], axis=1).astype(np.float32)
        assert np.array_equal(segments.reshape(-1, 2, 3), expected)
    assert np.array_equal(shapes.pins, arrays.positions[[(GROOVE - 1) * SEGMENTS]].astype(np.float32))


def test_each_contour_passes_its_own_pins():
    shown = made(3, GROOVE + 3)
    pins = [(0, 4 * SEGMENTS + 2), (1, (GROOVE + 2) * SEGMENTS + 9)]
    state = preview_state.State.start(DEFAULTS | {"width": 3, "reach": 0.0}, "SELECT", pins)
    shown.search(state)
    for contour, vertex in pins:
        assert vertex in shown.outcomes[contour].result.vertices


def test_a_pin_outside_the_band_gives_a_band_and_no_result():
    shown, state = (
        made(GROOVE - 3),
        start(width=1).toggled(0, 16 * SEGMENTS).toggled(0, 15 * SEGMENTS).toggled(0, (GROOVE - 3) * SEGMENTS),
    )
    with pytest.raises(ValueError, match="outside the band"):
        shown.search(state)
    assert shown.pins_outside(state) == 2
    assert shown.outcomes[0].result is None
    assert len(shown.bands[0]) > 0
    assert len(shown.shapes(state).found) == 0


def test_a_click_finds_the_nearest_vertex_in_front(rng):
    shown = made(GROOVE - 3)
    shown.search(start(width=3, reach=0.0))
    faces = shown.bands[0]
    for face in rng.choice(faces, 20):
        vertices = corners(shown.arrays, face)
        points = shown.arrays.positions[vertices]
        target = 0.8 * points[0] + 0.2 * points.mean(axis=0)
        outwards = np.array([*target[:2], 0.0])
        hit = shown.pick(target + 3 * outwards, -outwards)
        assert hit[1:] == (0, vertices[0])
        assert hit[0] == pytest.approx(3, abs=0.05)


def test_a_click_outside_the_band_finds_nothing():
    shown = made(GROOVE - 3)
    shown.search(start(width=1))
    assert shown.pick((5.0, 0.0, 3.9), (-1.0, 0.0, 0.0)) is None
    assert shown.pick((5.0, 5.0, 1.7), (0.0, 0.0, 1.0)) is None


def test_where_bands_overlap_the_nearest_contour_is_clicked():
    shown = made(4, 8)
    shown.search(start(width=3, reach=0.0))
    for row, contour in ((5, 0), (7, 1)):
        x, y, z = shown.arrays.positions[row * SEGMENTS]
        assert shown.pick((3.0, y + 0.01, z + 0.01), (-1.0, 0.0, 0.0))[1:] == (contour, row * SEGMENTS)
