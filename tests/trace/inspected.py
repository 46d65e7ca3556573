"""The requirements that are inspected instead of tested: id, reason, and where to look."""
import re
import tomllib

LIST = "tests/trace/inspected.toml"
FIELDS = ("id", "reason", "where")


def read_inspected(root, problems):
    """{identifier: entry}, each entry with the line that it stands at."""
    path = root / LIST
    if not path.exists():
        return {}
    text = path.read_text()
    try:
        document = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        problems.append(f"{LIST}:1: cannot be read: {error}")
        return {}
    entries = document.get("requirement", [])
    lines = [text.count("\n", 0, match.start()) + 1 for match in re.finditer(r"^\[\[requirement\]\]", text, re.MULTILINE)]
    if set(document) - {"requirement"} or len(lines) != len(entries):
        problems.append(f"{LIST}:1: holds something else than entries that begin with a line [[requirement]]")
        return {}
    listed = {}
    for line, entry in zip(lines, entries):
        place = f"{LIST}:{line}"
        if set(entry) != set(FIELDS) or not all(isinstance(entry[field], str) and entry[field].strip() for field in FIELDS):
            problems.append(f"{place}: an entry needs exactly {', '.join(FIELDS)}")
            continue
        missing = [name for name in entry["where"].split(", ") if not (root / name).exists()]
        if missing:
            problems.append(f"{place}: {entry['id']}: where to look is not there: {', '.join(missing)}")
        if entry["id"] in listed:
            problems.append(f"{place}: {entry['id']} is listed twice")
        listed[entry["id"]] = {**entry, "place": place}
    return listed
