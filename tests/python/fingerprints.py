# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints one line for each of 1,000 searches. Lines are equal if the results are equal to the last bit.

python tests/python/fingerprints.py
python tests/python/fingerprints.py --write FILE
python tests/python/fingerprints.py FILE --every 10

The second command writes the searches to a file, and the third runs every tenth of a file's. To compare machines, run
the same file on each: the searches are made with NumPy, whose own functions differ by processor. Running a file takes
only NumPy and the module.
"""

import argparse
import hashlib
import json
import lzma
import sys
from pathlib import Path

import mrcontour as mrc
import numpy as np


def bytes_of(result):
    """Every number of a result, to the last bit, and its codes, but not its messages, which may be reworded."""
    arrays = [result.positions, result.edge_vertices, result.edge_parameters, result.history]
    numbers = [result.ratio, result.objective, result.salience, result.lower_bound, result.gap]
    counts = [result.statistics[name] for name in ("faces", "cut", "nodes", "arcs", "linear_steps", "passes")]
    plain = [np.asarray(values).tobytes() for values in (*arrays, numbers)]
    plain.append(np.asarray(counts, dtype=np.int64).tobytes())  # NumPy's own integers are shorter on some systems
    return b"|".join([*plain, result.status.encode(), result.reason_code.encode()])


def line(case):
    """The name and the hash of a case's results, which must be the same for one thread and several."""
    positions, *indices = case["mesh"]
    surface = mrc.Surface(np.array(positions), *(np.array(part, dtype=np.int32) for part in indices))
    contours = [np.array(contour, dtype=np.int32) for contour in case["contours"]]
    found = set()
    for threads in (1, 3):
        try:
            options = mrc.Options(**case["options"], threads=threads)
            results = mrc.optimize_all(surface, contours, closed=case["closed"], options=options)
            content = b"/".join(map(bytes_of, results))
        except ValueError as error:
            content = type(error).__name__.encode()
        found.add(hashlib.sha256(content).hexdigest()[:16])
    return " ".join([case["name"], *sorted(found)]) + (" THREADS DIFFER" if len(found) > 1 else "")


def made_cases():
    from fingerprint_cases import made_cases  # needs the packages of the tests

    return made_cases()


def write(cases, file):
    """Compressed, each mesh once. JSON gives back the same floats."""
    meshes, numbered, numbers = [], [], {}
    for case in cases:
        number = numbers.setdefault(json.dumps(case["mesh"]), len(meshes))
        meshes += [case["mesh"]] if number == len(meshes) else []
        numbered.append(case | {"mesh": number})
    text = json.dumps({"meshes": meshes, "cases": numbered})
    file.write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def read(file):
    content = json.loads(lzma.decompress(file.read_bytes()))
    return [case | {"mesh": content["meshes"][case["mesh"]]} for case in content["cases"]]


def spread(cases, every):
    """Every n-th case, a little later each time, as kinds of cases alternate."""
    return (case for i, case in enumerate(cases) if i % every == i // every % every)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path, nargs="?", help="what --write wrote; without it, the cases are made")
    parser.add_argument("--write", action="store_true", help="write the cases to the file instead of searching")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="take only every N-th case")
    arguments = parser.parse_args()
    if arguments.write and not arguments.file:
        parser.error("--write needs a file")
    cases = read(arguments.file) if arguments.file and not arguments.write else made_cases()
    cases = spread(cases, arguments.every)
    if arguments.write:
        write(cases, arguments.file)
        return
    sys.stdout.reconfigure(newline="\n")  # the same bytes on Windows
    for case in cases:
        print(line(case), flush=True)


if __name__ == "__main__":
    main()
