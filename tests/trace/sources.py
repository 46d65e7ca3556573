"""The sources that a document names in `code`, and how many proof goals the proved ones among them have."""
import json
import re

KERNEL = "safety_kernel"
GOALS = "proofs/goals.json"
ENDINGS = ("", ".c", ".h", ".cpp", ".hpp")
CODE = re.compile(r"`([\w./]+)`")


def source_of(root, folder, name):
    """A name as documents have it (`core/clearance.h`, `io/peers`, `record`, a header beside the document): the source without ending, or None
    where the name is of something else."""
    for base in (f"{KERNEL}/", f"{folder}/"):
        for ending in ENDINGS:
            path = root / f"{base}{name}{ending}"
            if path.is_file() and path.suffix in (".c", ".h", ".cpp", ".hpp", ".dbc"):
                return path.relative_to(root).with_suffix("").as_posix()
    rooms = {path.name for path in (root / KERNEL).glob("*/") if path.is_dir()} - {"requirements"}
    return f"{KERNEL}/{name}" if name in rooms else None


def named_sources(root, document, lines):
    folder = document.parent.relative_to(root).as_posix()
    sources = (source_of(root, folder, name) for name in CODE.findall("\n".join(lines)))
    return list(dict.fromkeys(source for source in sources if source))


def room_of(root, document):
    """What an interface's document stands beside, where it names no source itself."""
    folder = document.parent.relative_to(root)
    return [folder.as_posix()] if folder.parts[0] == "interface_spec" and len(folder.parts) > 1 else []


def read_goals(root):
    """{source: number of proof goals} of the proved units of the core."""
    path = root / GOALS
    units = json.loads(path.read_text())["units"] if path.exists() else {}
    return {f"{KERNEL}/core/{unit}": goals for unit, goals in units.items() if (root / f"{KERNEL}/core/{unit}.c").exists()}
