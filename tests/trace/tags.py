"""The tags of the tests: comments with the word `verifies`, a colon and a list of requirements, each before the test that it is of."""
from dataclasses import dataclass

from cpp_tests import read_cpp
from identifiers import Malformed, read_list
from python_tests import read_python

READERS = {".cpp": read_cpp, ".hpp": read_cpp, ".h": read_cpp, ".c": read_cpp, ".py": read_python}


@dataclass
class Verification:
    requirement: str
    test: str
    file: str
    line: int  # of the tag
    remark: str  # which part of the requirement, where it is not the whole

    @property
    def place(self):
        return f"{self.file}:{self.line}"


def read_tags(root, problems):
    """Every verification that the tests claim. Tags of no test, and lists that cannot be read, are problems."""
    found = []
    for path in sorted(p for p in (root / "tests").rglob("*") if p.suffix in READERS):
        file = path.relative_to(root).as_posix()
        for tag in READERS[path.suffix](path):
            place = f"{file}:{tag.line}"
            if tag.fault:
                problems.append(f"{place}: malformed tag: {tag.fault}")
                continue
            try:
                named = read_list(tag.text)
            except Malformed as error:
                problems.append(f"{place}: malformed tag: {error}")
                continue
            if tag.test is None:
                problems.append(f"{place}: no test follows this tag{': ' + tag.why if tag.why else ''}")
                continue
            found += [Verification(identifier, tag.test, file, tag.line, remark) for identifier, remark in named]
    return found
