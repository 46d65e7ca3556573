"""What the build files of a test's folder say of it."""
import re
from functools import lru_cache


@lru_cache(maxsize=None)
def build_file(folder):
    path = folder / "CMakeLists.txt"
    return re.sub(r"#.*", "", path.read_text()) if path.exists() else ""


def is_built(path):
    return re.search(rf"(?<![\w.-]){re.escape(path.name)}(?![\w.-])", build_file(path.parent)) is not None


def script_test(path):
    """The name under which ctest runs a script, or None."""
    for match in re.finditer(r"\badd(?:_system)?_test\s*\(([^)]*)\)", build_file(path.parent)):
        words = match[1].split()
        name = words[1] if words[0] == "NAME" else words[0]
        if any(word.rsplit("/", 1)[-1] == path.name for word in words):
            return name
    return None
