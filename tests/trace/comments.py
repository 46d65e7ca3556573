"""A tag within the lines of a comment: where it begins, how it goes on, and what only looks like one."""
import re
from dataclasses import dataclass

from identifiers import IDENTIFIER

BEGIN = re.compile(r"(?:^|\s)verifies: (\S.*)$")
# Misspelt it would be overlooked, and the requirement with it.
NEARLY = re.compile(rf"\bverif(?:y|ies|ied)\b\s*:|\bverif(?:y|ies|ied)\b.*\b{IDENTIFIER}\b|\b{IDENTIFIER}\b.*\bverified\b", re.IGNORECASE)


@dataclass
class Tag:
    line: int
    text: str = ""
    fault: str = ""  # why it cannot be read at all
    test: str | None = None
    why: str = ""  # why it has no test, where that is not plain


def tags_of(lines):
    """The tags of one comment, given as [(line number, text without comment marks)]. A list that ends with a comma goes on in the next line."""
    tags, open_tag = [], None
    for number, text in lines:
        text = text.strip()
        begin = BEGIN.search(text)
        if begin:
            open_tag = Tag(number, begin[1].strip())
            tags.append(open_tag)
        elif open_tag is not None and open_tag.text.endswith(","):
            open_tag.text += " " + text
        elif NEARLY.search(text):
            tags.append(Tag(number, fault=f"'{text}' is not 'verifies: NAME, NAME'"))
    return tags
