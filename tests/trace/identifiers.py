"""Identifiers of requirements, and lists of them as a tag has them: `SK-FS-2 to SK-FS-6, SK-WM-68, 71, IF-CT-13 (the hold alone)`."""
import re

IDENTIFIER = r"(?:SK|IF)-[A-Z]+-[0-9]+"
ITEM = re.compile(rf"({IDENTIFIER}|[0-9]+)(?: to ({IDENTIFIER}|[0-9]+))?(?: \(([^()]+)\))?")


class Malformed(Exception):
    """A list that cannot be read; its text says why."""


def split(identifier):
    series, number = identifier.rsplit("-", 1)
    return series, int(number)


def sort_key(identifier):
    return split(identifier)


def read_list(text):
    """[(identifier, remark or "")] of a tag's text. A bare number is of the series of the identifier before it."""
    named, series = [], None
    for item in (part.strip() for part in re.split(r",(?![^(]*\))", text)):
        match = ITEM.fullmatch(item)
        if not match:
            raise Malformed(f"'{item}' is no identifier, nor a range of them" if item else "an identifier is missing")
        first, last, remark = match.groups()
        if first.isdigit() and series is None:
            raise Malformed(f"'{item}' follows no identifier")
        low_series, low = split(first) if "-" in first else (series, int(first))
        high_series, high = (low_series, low) if last is None else split(last) if "-" in last else (low_series, int(last))
        if high_series != low_series:
            raise Malformed(f"'{item}' goes from one series to another")
        if last is not None and high <= low:
            raise Malformed(f"'{item}' goes backwards")
        series = low_series
        named += [(f"{series}-{number}", remark or "") for number in range(low, high + 1)]
    return named
