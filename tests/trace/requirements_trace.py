#!/usr/bin/python3
"""Traces each requirement to the tests that name it, to its source, and to the number of proof goals where that is proved.

Prints the matrix, or writes it, and a summary. Exit 1, with a line for each on standard error, for: a tag of an unknown requirement, of no test,
or malformed; a requirement defined twice, without a source, or without a test where tests/trace/inspected.toml does not list it; an entry of that
list that is stale. No file is written then. That a test names a requirement does not say that it suffices."""

import argparse
import os
import sys
from pathlib import Path

import matrix
import report

ROOT = Path(__file__).resolve().parent.parent.parent


def arguments():
    p = argparse.ArgumentParser(prog="berm trace", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--id", metavar="NAME", help="this requirement alone, in full")
    p.add_argument("--out", metavar="FILE", type=Path, help="write the matrix as markdown, instead of printing it; a file that is there is replaced as a whole")
    p.add_argument("--csv", metavar="FILE", type=Path, help="write it with comma-separated values, a line for each requirement and test")
    p.add_argument("--root", metavar="FOLDER", type=Path, default=ROOT, help="of another repository than this one")
    a = p.parse_args()
    if a.id and (a.out or a.csv):
        p.error("--id prints one requirement: not with --out or --csv")
    return a


def write_whole(path, words):
    """Beside its place, then renamed: there whole or not at all."""
    half = path.with_name(path.name + ".part")
    there = path.exists()
    if there and not path.is_file():  # a folder; or a device, which a rename would replace
        raise SystemExit(f"berm trace: {path}: is no file")
    try:
        half.write_text(words)
        os.replace(half, path)
    except OSError as error:
        half.unlink(missing_ok=True)
        raise SystemExit(f"berm trace: {path}: cannot be written: {error.strerror}") from error
    print(f"{path} {'replaced' if there else 'written'}")


def main():
    a = arguments()
    m = matrix.build(a.root.resolve())
    if a.id and a.id not in m.rows:
        sys.stderr.write(f"berm trace: --id {a.id}: no such requirement\n")
        return 2
    if a.id:
        print(report.row_text(m.rows[a.id], whole=True))
    elif not a.out and not a.csv:
        print(report.text(m))
    sys.stdout.flush()
    for problem in m.problems:
        sys.stderr.write(problem + "\n")
    if not m.problems:
        for path, form in ((a.out, report.markdown), (a.csv, report.comma_separated)):
            if path:
                write_whole(path, form(m))
    if not a.id:
        print(m.summary())
    return 1 if m.problems else 0


if __name__ == "__main__":
    sys.exit(main())
