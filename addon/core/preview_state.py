# SPDX-License-Identifier: GPL-3.0-or-later
"""How the mouse wheel, keys and clicks change the settings while a contour is adjusted. Does not need Blender."""

from dataclasses import dataclass, replace

from .parameters import SETTINGS

OUTPUTS = ("SELECT", "SEAM", "SHARP", "CUT", "RIP", "SEPARATE")
CONFIRM, CANCEL, PIN, PASS, IGNORE = "CONFIRM", "CANCEL", "PIN", "PASS", "IGNORE"

_BIAS_STEP = 0.5
_SHIFTED = {
    "R": ("FINER", "COARSER"),
    "S": ("SHORTER", "LONGER"),
    "O": ("NEXT_OUTPUT", "LAST_OUTPUT"),
}  # command, and command with Shift
_PLAIN = {
    "WHEELUPMOUSE": "WIDER",
    "WHEELDOWNMOUSE": "NARROWER",
    "PAGE_UP": "WIDER",
    "PAGE_DOWN": "NARROWER",
    "E": "REACH",
    "W": "WHOLE_SURFACE",
    "X": "UNPIN_ALL",
    "LEFTMOUSE": PIN,
    "RET": CONFIRM,
    "NUMPAD_ENTER": CONFIRM,
    "SPACE": CONFIRM,
    "ESC": CANCEL,
    "RIGHTMOUSE": CANCEL,
}
_WHEEL = ("WHEELUPMOUSE", "WHEELDOWNMOUSE")
# With Ctrl, some number pad keys do more than turn the view: they grow the selection or set the camera.
_VIEWS = tuple(f"NUMPAD_{digit}" for digit in range(1, 10))
_VIEWS_WHEN_PLAIN = ("NUMPAD_0", "NUMPAD_PLUS", "NUMPAD_MINUS", "NUMPAD_PERIOD", "HOME")
_NAVIGATION = ("MIDDLEMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM")
_NOT_INPUT = ("TIMER", "NDOF", "WINDOW_DEACTIVATE", "NONE")


@dataclass(frozen=True)
class State:
    """Everything that the user can change; each pin is (index of the contour in the list, vertex)."""

    settings: dict
    output: str = "SELECT"
    pins: frozenset = frozenset()
    reach: float = SETTINGS["reach"]["default"]  # the value that turning the reach on restores

    @classmethod
    def start(cls, settings, output, pins=()):
        return cls(dict(settings), output, frozenset(pins), settings["reach"] or SETTINGS["reach"]["default"])

    def pins_of(self, contour):
        """Return the vertices pinned on one contour, in ascending order."""
        return sorted(vertex for owner, vertex in self.pins if owner == contour)

    def stray_pins(self, count):
        """Return how many pins belong to none of the first `count` contours."""
        return sum(not 0 <= owner < count for owner, _ in self.pins)

    def toggled(self, contour, vertex):
        """Pin a vertex, or unpin it from whichever contour it is pinned on."""
        pinned = frozenset(pin for pin in self.pins if pin[1] == vertex)
        return replace(self, pins=self.pins - pinned if pinned else self.pins | {(contour, vertex)})

    def with_settings(self, **changes):
        return replace(self, settings=self.settings | changes)


def command_of(event_type, shift=False, ctrl=False, alt=False):
    """Return the command for a key, a mouse button or the mouse wheel."""
    modified = shift or ctrl or alt
    if event_type in _NAVIGATION or event_type.startswith(_NOT_INPUT):
        return PASS
    if event_type in _VIEWS and not alt:
        return PASS
    if event_type in _VIEWS_WHEN_PLAIN and not modified:
        return PASS
    if event_type in _WHEEL and modified:
        return IGNORE if alt else PASS  # Blender pans the view with these; with Alt it would change the frame
    if ctrl or alt:
        return IGNORE
    if event_type in _SHIFTED:
        return _SHIFTED[event_type][shift]
    return IGNORE if shift else _PLAIN.get(event_type, IGNORE)


def changed(state, command):
    """Return the state after a command; the same object if the command changes nothing."""
    change = _CHANGES.get(command)
    after = change(state) if change else state
    return state if after == state else after


def _stepped(state, name, step):
    row = SETTINGS[name]
    most = row["max"] if "max" in row else row["soft_max"]
    value = state.settings[name]
    # A value beyond the soft limit was typed in: it may be lowered, but not raised any further.
    return state.with_settings(**{name: max(row["min"], min(value + step, max(most, value)))})


def _wider(state, step):
    if state.settings["whole_surface"]:
        return state.with_settings(whole_surface=False)
    return _stepped(state, "width", step)


def _next_output(state, step):
    place = (OUTPUTS.index(state.output) + step) % len(OUTPUTS)
    return replace(state, output=OUTPUTS[place])


def _reach(state):
    return state.with_settings(reach=0.0 if state.settings["reach"] > 0 else state.reach)


_CHANGES = {
    "WIDER": lambda state: _wider(state, 1),
    "NARROWER": lambda state: _wider(state, -1),
    "FINER": lambda state: _stepped(state, "refinement", 1),
    "COARSER": lambda state: _stepped(state, "refinement", -1),
    "SHORTER": lambda state: _stepped(state, "length_bias", _BIAS_STEP),
    "LONGER": lambda state: _stepped(state, "length_bias", -_BIAS_STEP),
    "NEXT_OUTPUT": lambda state: _next_output(state, 1),
    "LAST_OUTPUT": lambda state: _next_output(state, -1),
    "REACH": _reach,
    "WHOLE_SURFACE": lambda state: state.with_settings(whole_surface=not state.settings["whole_surface"]),
    "UNPIN_ALL": lambda state: replace(state, pins=frozenset()),
}


def is_wider(state, before):
    """Whether the width was raised while the reach may limit the band."""
    now, then = state.settings, before.settings
    return now["width"] > then["width"] and now["reach"] > 0 and not now["whole_surface"]


def header(state, output_name, outcome, held=False):
    """Return the header text: the settings that the keys change, and the outcome with these settings.

    held: whether the reach limits the band and not the width, so that a greater width changes nothing.
    """
    settings = state.settings
    width = "Whole Surface" if settings["whole_surface"] else f"Width: {settings['width']}"
    if not settings["whole_surface"]:
        width += f", Reach: {settings['reach']:.2f}" if settings["reach"] > 0 else ", Reach: off"
        width += " limits the band (E: off)" if held else ""
    pins = f", Pins: {len(state.pins)}" if state.pins else ""
    return (
        f"{width}, Refinement: {settings['refinement']}, Short: {settings['length_bias']:.1f}, "
        f"Output: {output_name}{pins}   |   {outcome}"
    )
