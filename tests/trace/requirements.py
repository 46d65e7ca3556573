"""The requirements: list items `- **SK-XX-n** text` and `- **IF-XX-n** text`, with the sources that their documents name."""
import re
from dataclasses import dataclass

from identifiers import IDENTIFIER
from sources import named_sources, room_of

FOLDERS = ("safety_kernel/requirements", "interface_spec")
ITEM = re.compile(rf"- \*\*({IDENTIFIER})\*\* (\S.*)")
NEARLY = re.compile(rf"\s*[-*+]\s+[*_]*{IDENTIFIER}\b")  # a list item that begins so and is none would be overlooked


@dataclass
class Requirement:
    identifier: str
    file: str  # from the repository's root
    line: int
    text: str
    sources: list

    @property
    def place(self):
        return f"{self.file}:{self.line}"

    @property
    def says_test(self):
        """Its own words say that it, or a part of it, is no clause of a contract."""
        return re.search(r"\((?:[^()]*[ :])?test[):]", self.text) is not None


def read_document(root, path, problems):
    """The requirements of one document. Its sources are those that its section names outside its items, or else the
    document's head, or else the room that an interface's document stands in."""
    file = path.relative_to(root).as_posix()
    found, contexts, item = [], [], None
    head, section, in_section = [], [], False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = ITEM.fullmatch(line)
        if match:
            item = Requirement(match[1], file, number, match[2].strip(), [])
            found.append(item)
            contexts.append((head, section))
            continue
        if NEARLY.match(line):
            problems.append(f"{file}:{number}: neither text nor requirement: a requirement is '- **NAME** text'")
        if item is not None and line.startswith("  "):
            item.text += " " + line.strip()
            continue
        item = None
        if line.startswith("## "):
            section, in_section = [], True
        elif in_section:
            section.append(line)
        else:
            head.append(line)
    for requirement, (head, section) in zip(found, contexts):
        requirement.sources = named_sources(root, path, section) or named_sources(root, path, head) or room_of(root, path)
    return found


def read_requirements(root, problems):
    """{identifier: Requirement} of the whole repository, in the order of the documents."""
    known = {}
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.md")):
            for requirement in read_document(root, path, problems):
                first = known.setdefault(requirement.identifier, requirement)
                if first is not requirement:
                    problems.append(f"{requirement.place}: {requirement.identifier} is defined twice: {first.place} has it as well")
    return known
