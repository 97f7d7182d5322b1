# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs clang-tidy on the C++ files that changed since all files last passed, or on all, and writes a JUnit report.

A changed header selects the files that include it. The commit on which all files last passed is kept in
.clang-tidy-passed. If it is unknown, as in a shallow clone, or if the checks themselves changed, all files are checked.
Files left out because of a time limit are reported as skipped. Files that passed are recorded in the build folder by
their content, so that the next run continues with the rest.
"""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
PASSED = ROOT / ".clang-tidy-passed"
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def git(*arguments):
    """The lines of the output, or None if git fails. In a container, the clone may belong to another user."""
    run = subprocess.run(
        ["git", "-c", f"safe.directory={ROOT}", "-C", ROOT, *arguments], capture_output=True, text=True
    )
    return run.stdout.splitlines() if run.returncode == 0 else None


def changed_files():
    """The files that changed since all files last passed, or None if that is unknown."""
    passed = PASSED.read_text().split()[0] if PASSED.exists() else ""
    differing = git("diff", "--name-only", "--no-renames", f"{passed}^{{commit}}", "--") if passed else None
    untracked = git("ls-files", "--others", "--exclude-standard")
    if differing is None or untracked is None:
        return None
    changed = {ROOT / name for name in differing + untracked}
    return None if any(path.name == ".clang-tidy" for path in changed) else changed


class Includes:
    """Which of the repository's headers a file includes, directly or not."""

    def __init__(self, headers):
        self.headers = list(headers)
        self.known = {}

    def direct(self, path):
        if path not in self.known:
            names = INCLUDE.findall(path.read_text(encoding="utf-8"))
            self.known[path] = {
                header
                for header in self.headers
                for name in names
                if header.as_posix().endswith("/" + name.lstrip("./"))
            }
        return self.known[path]

    def all(self, path):
        found, waiting = set(), [path]
        while waiting:
            new = self.direct(waiting.pop()) - found
            found |= new
            waiting += new
        return found


def chosen_units(units, includes, changed):
    """The units to check: first those that changed, then those whose own header changed, then the rest."""

    def rank(unit):
        own_header = any(header.stem == unit.stem and header in changed for header in includes.all(unit))
        return (unit not in changed, not own_header, str(unit))

    return sorted((unit for unit in units if changed & ({unit} | includes.all(unit))), key=rank)


def content_key(tool, command, unit, includes):
    """A hash of everything in this repository that a result depends on: while it is the same, so is the result."""
    parts = [tool, command]
    for path in (unit, *sorted(includes.all(unit)), ROOT / ".clang-tidy", *sorted(ROOT.glob("*/*/.clang-tidy"))):
        parts += [str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def report(path, results, since):
    """Writes a test case for each unit: None means passed, "" skipped, and other text is the failure."""
    suite = ElementTree.Element("testsuite", name="clang-tidy", tests=str(max(1, len(results))))
    suite.set("failures", str(sum(bool(found) for found in results.values())))
    suite.set("skipped", str(sum(found == "" for found in results.values())))
    for unit, found in results.items() or [(f"nothing changed since {since}", None)]:
        case = ElementTree.SubElement(suite, "testcase", classname="clang-tidy", name=str(unit))
        if found is not None:
            ElementTree.SubElement(case, "failure" if found else "skipped").text = found
    ElementTree.ElementTree(suite).write(path, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--tool", default="clang-tidy", help="the program")
    parser.add_argument("--build", type=Path, required=True, help="a build folder with compile_commands.json")
    parser.add_argument("--report", type=Path, required=True, help="where the JUnit report goes")
    parser.add_argument("--whole", action="store_true", help="check all files, and record the commit if they pass")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="start no file after this time")
    arguments = parser.parse_args()

    commands = json.loads((arguments.build / "compile_commands.json").read_text())
    commands = {Path(entry["file"]): entry["command"] for entry in commands}
    headers = [path for folder in ("native", "tests") for path in (ROOT / folder).rglob("*.h")]
    includes = Includes(headers)
    changed = None if arguments.whole else changed_files()
    units = sorted(commands) if changed is None else chosen_units(commands, includes, changed)
    tool = subprocess.run([arguments.tool, "--version"], check=True, capture_output=True, text=True).stdout
    remembered = ROOT / "build" / "clang-tidy"
    remembered.mkdir(parents=True, exist_ok=True)
    end = time.monotonic() + arguments.seconds

    def check(unit):
        stamp = remembered / content_key(tool, commands[unit], unit, includes)
        if stamp.exists():
            return None
        if time.monotonic() > end:
            return ""
        command = [arguments.tool, "-quiet", "-p", arguments.build, unit]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode:
            print(run.stdout, run.stderr, flush=True)
            return run.stdout or run.stderr or "failed"
        stamp.touch()
        return None

    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        results = dict(zip((unit.relative_to(ROOT) for unit in units), pool.map(check, units)))
    since = PASSED.read_text().split()[0] if PASSED.exists() else "an unknown commit"
    report(arguments.report, results, since)
    left = sum(found == "" for found in results.values())
    print(f"{len(results)} files to check since {since}, {left} left for the next run")
    clean = git("status", "--porcelain", "--", "*.cpp", "*.h", "*.clang-tidy") == []
    if arguments.whole and clean and not any(found is not None for found in results.values()):
        (head,) = git("rev-parse", "HEAD")
        PASSED.write_text(f"{head} is the last commit on which all files passed clang-tidy: tests/run --full lint\n")
    sys.exit(any(results.values()))


if __name__ == "__main__":
    main()
