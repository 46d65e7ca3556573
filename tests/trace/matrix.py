"""The matrix: each requirement with what verifies it and what is proved of its source; and what is wrong with it."""
from dataclasses import dataclass, field

from identifiers import sort_key
from inspected import read_inspected
from requirements import Requirement, read_requirements
from sources import KERNEL, read_goals
from tags import read_tags


@dataclass
class Row:
    requirement: Requirement
    tests: list = field(default_factory=list)  # of Verification
    goals: dict = field(default_factory=dict)  # {source: goals or None where it is not proved}
    inspected: dict | None = None

    @property
    def in_parts_only(self):
        return bool(self.tests) and all(v.remark for v in self.tests)

    @property
    def proved_units(self):
        return [source for source, goals in self.goals.items() if goals]


@dataclass
class Matrix:
    rows: dict
    problems: list

    def summary(self):
        rows = self.rows.values()
        return (f"{len(rows)} requirements, {sum(bool(r.tests) for r in rows)} verified by tests "
                f"({sum(r.in_parts_only for r in rows)} of them in named parts only), {sum(bool(r.proved_units) for r in rows)} of proved units "
                f"({sum(bool(r.proved_units) and r.requirement.says_test for r in rows)} of them say (test)), "
                f"{sum(r.inspected is not None and not r.tests for r in rows)} by inspection")


def check_tests(rows, verifications, problems):
    for v in verifications:
        row = rows.get(v.requirement)
        if row is None:
            problems.append(f"{v.place}: {v.test} verifies {v.requirement}, which is no requirement")
        elif (v.test, v.file, v.remark) not in {(t.test, t.file, t.remark) for t in row.tests}:
            row.tests.append(v)


def check_inspected(rows, listed, problems):
    for identifier, entry in listed.items():
        row = rows.get(identifier)
        if row is None:
            problems.append(f"{entry['place']}: {identifier} is listed as inspected, and is no requirement")
            continue
        row.inspected = entry
        if row.tests:
            problems.append(f"{entry['place']}: {identifier} is listed as inspected, and {row.tests[0].test} ({row.tests[0].place}) verifies it")


def build(root):
    problems = []
    requirements = read_requirements(root, problems)
    if not requirements:
        problems.append(f"{KERNEL}/requirements:1: no requirements found")
    goals = read_goals(root)
    rows = {r.identifier: Row(r, goals={s: goals.get(s) for s in r.sources}) for r in sorted(requirements.values(), key=lambda r: sort_key(r.identifier))}
    check_tests(rows, read_tags(root, problems), problems)
    check_inspected(rows, read_inspected(root, problems), problems)
    for row in rows.values():
        if not row.tests and row.inspected is None:
            problems.append(f"{row.requirement.place}: {row.requirement.identifier} is verified by no test, and is not listed as inspected")
        if not row.goals:
            problems.append(f"{row.requirement.place}: {row.requirement.identifier}: neither its section nor the document's head names a source")
    named = {source for row in rows.values() for source in row.goals}
    for source in sorted(set(goals) - named):
        problems.append(f"proofs/goals.json:1: {source} is proved, and no requirement names it as its source")
    return Matrix(rows, problems)
