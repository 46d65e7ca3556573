"""The matrix as text, as markdown, as CSV, and one requirement in full."""
import csv
import io

SHORT = 70


def shortened(text):
    return text if len(text) <= SHORT else text[:SHORT - 3].rstrip() + "..."


def test_name(v):
    return f"{v.test} ({v.remark})" if v.remark else v.test


def source_name(row, source):
    goals = row.goals[source]
    return f"{source} ({goals} goals{'; the sentence says (test)' if row.requirement.says_test else ''})" if goals else source


def row_text(row, whole=False):
    r = row.requirement
    lines = [f"{r.identifier}  {r.place}  {r.text if whole else shortened(r.text)}"]
    lines += [f"    test     {test_name(v)}  {v.place}" for v in row.tests]
    if row.inspected:
        lines.append(f"    inspect  {row.inspected['where']}  {row.inspected['reason']}")
    lines += [f"    source   {source_name(row, source)}" for source in row.goals]
    return "\n".join(lines)


def text(matrix):
    return "\n".join(row_text(row) for row in matrix.rows.values())


def cell(words):
    return words.replace("|", "\\|").replace("\n", " ")


def markdown(matrix):
    lines = ["# Requirements, and what verifies them", "", f"{matrix.summary()}.", "",
             "A test stands here because it names the requirement; that it suffices is for a reviewer to judge. Goals are those of the whole unit: which sentences are",
             "clauses of its contracts the requirement's document says; one that says (test) is none, or not in all its parts.", "",
             "| requirement | where | text | verified by | source |", "|---|---|---|---|---|"]
    for row in matrix.rows.values():
        r = row.requirement
        by = [f"{test_name(v)} `{v.place}`" for v in row.tests] + ([f"inspection of `{row.inspected['where']}`: {row.inspected['reason']}"] if row.inspected else [])
        sources = [source_name(row, source) for source in row.goals]
        lines.append(f"| {r.identifier} | `{r.place}` | {cell(r.text)} | {cell('<br>'.join(by))} | {cell('<br>'.join(sources))} |")
    return "\n".join(lines) + "\n"


def comma_separated(matrix):
    """A line for each requirement and each test of it; one alone for what is inspected."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["requirement", "file", "line", "text", "how", "test", "test_file", "test_line", "part", "sources", "proof_goals", "says_test"])
    for row in matrix.rows.values():
        r = row.requirement
        proved = row.proved_units
        end = [" ".join(row.goals), " ".join(f"{source.rsplit('/', 1)[-1]}={row.goals[source]}" for source in proved), "yes" if r.says_test else ""]
        begin = [r.identifier, r.file, r.line, r.text]
        for v in row.tests:
            writer.writerow([*begin, "test", v.test, v.file, v.line, v.remark, *end])
        if not row.tests:
            writer.writerow([*begin, "inspection" if row.inspected else "", "", row.inspected["where"] if row.inspected else "", "",
                             row.inspected["reason"] if row.inspected else "", *end])
    return out.getvalue()
