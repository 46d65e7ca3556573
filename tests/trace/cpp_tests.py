"""Tags in C and C++: in line comments before a test's macro, or behind it on its line."""
import re

from comments import Tag, tags_of
from registered import is_built

MACRO = re.compile(r"\s*(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP|RC_GTEST_TYPED_FIXTURE_PROP)\s*\(\s*(\w+)\s*,\s*(\w+)")
COMMENT = re.compile(r"^(.*?)//+(.*)$")
BLOCK = re.compile(r"/\*(.*?)\*/", re.DOTALL)


def name_of_test(lines, begin, path):
    """Suite.Name of the test whose macro stands at this line, and, where there is none, why that is not plain."""
    match = MACRO.match("\n".join(lines[begin:begin + 3]))
    if not match:
        return None, ""
    if match[2].startswith("DISABLED_") or match[3].startswith("DISABLED_"):
        return None, f"{match[2]}.{match[3]} is disabled"
    if not is_built(path):
        return None, f"{path.parent.name}/CMakeLists.txt does not build {path.name}"
    return f"{match[2]}.{match[3]}", ""


def read_cpp(path):
    text = path.read_text()
    lines = text.splitlines()
    tags = [Tag(text.count("\n", 0, block.start()) + 1, fault="not in a line comment") for block in BLOCK.finditer(text) if tags_of([(0, block[1])])]
    comment = []
    for number, line in enumerate(lines, 1):
        match = COMMENT.match(line)
        code = match[1] if match else line
        if match and not code.strip():
            comment.append((number, match[2]))
            continue
        found = tags_of(comment) + (tags_of([(number, match[2])]) if match else [])
        if found and (code.strip() or number == len(lines)):
            test, why = name_of_test(lines, number - 1, path)
            for tag in found:
                tag.test, tag.why = test, why
        tags += found
        comment = []
    return tags + tags_of(comment)
