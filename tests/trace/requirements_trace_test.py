"""The tool on small made-up repositories: what it reads, and that it refuses each thing that it says it refuses."""
import csv
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parent / "requirements_trace.py"
GOOD = {
    "safety_kernel/core/slope.c": "", "safety_kernel/core/slope.h": "", "safety_kernel/io/feed.hpp": "",
    "proofs/goals.json": json.dumps({"units": {"slope": 12, "theorem": 3}}),
    "safety_kernel/requirements/slope.md": """# Slope

`core/slope.h` decides.

- **SK-AB-1** The slope is the rise over the run, whatever the ground is made of, and never steeper than what was measured there | or less.
  Level ground has none.
- **SK-AB-2** Steep is steep (test).
- **SK-AB-3** Nothing else.

## In the cycle

`io/feed.hpp`; tested, not proved.

- **SK-AB-4** It is fed.
""",
    "interface_spec/wire/WIRE.md": "# Wire\n\n- **IF-W-1** Bytes.\n- **IF-W-2** Words.\n",
    "tests/unit/slope/CMakeLists.txt": "add_executable(test_slope test_slope.cpp)\n",
    "tests/unit/slope/test_slope.cpp": """// Slopes.
// verifies: SK-AB-1 to 3
// Why it is so.
TEST_F(Slope, RisesOverTheRun) {
}

// verifies: IF-W-1 (the length, in bytes),
// SK-AB-4
RC_GTEST_PROP(Slope,
              Feeds, (int x)) {}
TEST(Slope, Steep) {  // verifies: SK-AB-2
}
""",
    "tests/system/wire/CMakeLists.txt": "add_system_test(system_wire wire_test.py 600)\n",
    "tests/system/wire/wire_test.py": '"""Wire.\n\nverifies: IF-W-1"""\n\n\ndef words():\n    """verifies: IF-W-2"""\n\n\nTEXT = "# verifies: SK-ZZ-1"\n# verifies: IF-W-2\nmain([words])\n',
}
CPP, DOC, LIST = "tests/unit/slope/test_slope.cpp", "safety_kernel/requirements/slope.md", "tests/trace/inspected.toml"
ENTRY = '[[requirement]]\nid = "{0}"\nreason = "Nothing runs."\nwhere = "{1}"\n'


class Trace(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="berm-trace-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in GOOD.items():
            self.write(name, text)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def change(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertEqual(text.count(old), 1, f"'{old}' in {name}")
        self.write(name, text.replace(old, new))

    def run_tool(self, *options):
        return subprocess.run([sys.executable, str(TOOL), "--root", str(self.root), *map(str, options)], capture_output=True, text=True, timeout=60, check=False)

    def refused(self, *lines):
        """Status 1 with exactly these lines on standard error, whole, and no file written."""
        out = self.root / "matrix.md"
        done = self.run_tool("--out", out)
        self.assertEqual(done.stderr.splitlines(), list(lines))
        self.assertEqual(done.returncode, 1)
        self.assertFalse(out.exists(), "a matrix with problems was written")

    # What it reads.

    def test_good(self):
        done = self.run_tool()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual(lines[-1], "6 requirements, 6 verified by tests (0 of them in named parts only), 3 of proved units (1 of them say (test)), 0 by inspection")
        at = next(i for i, line in enumerate(lines) if line.startswith("SK-AB-1"))
        self.assertEqual(lines[at:at + 3], [f"SK-AB-1  {DOC}:5  The slope is the rise over the run, whatever the ground is made of,...",
                                            f"    test     Slope.RisesOverTheRun  {CPP}:2", "    source   safety_kernel/core/slope (12 goals)"])

    def test_one_in_full(self):
        done = self.run_tool("--id", "SK-AB-4")
        self.assertEqual(done.stdout, f"SK-AB-4  {DOC}:14  It is fed.\n    test     Slope.Feeds  {CPP}:7\n    source   safety_kernel/io/feed\n")
        self.assertIn("Level ground has none.", self.run_tool("--id", "SK-AB-1").stdout)
        done = self.run_tool("--id", "IF-W-2")
        self.assertEqual([line.split()[1] for line in done.stdout.splitlines()[1:]], ["system_wire:words", "system_wire", "interface_spec/wire"])
        done = self.run_tool("--id", "SK-AB-9")
        self.assertEqual((done.returncode, done.stderr), (2, "berm trace: --id SK-AB-9: no such requirement\n"))

    def test_named_parts(self):
        self.change("tests/system/wire/wire_test.py", "\n\nverifies: IF-W-1", "")
        self.assertIn("(1 of them in named parts only)", self.run_tool().stdout)
        self.assertIn("Slope.Feeds (the length, in bytes)", self.run_tool("--id", "IF-W-1").stdout)

    def test_a_test_stands_once(self):
        self.change(CPP, "// verifies: SK-AB-1 to 3\n", "// verifies: SK-AB-1 to 3\n// verifies: SK-AB-1, SK-AB-3 (nothing)\n")
        self.assertEqual(self.run_tool("--id", "SK-AB-1").stdout.count("Slope.RisesOverTheRun"), 1)
        self.assertEqual(self.run_tool("--id", "SK-AB-3").stdout.count("Slope.RisesOverTheRun"), 2)

    def test_files(self):
        markdown, table = self.root / "m.md", self.root / "m.csv"
        done = self.run_tool("--out", markdown, "--csv", table)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{markdown} written\n{table} written\n", done.stdout)
        self.assertIn("measured there \\| or less. Level ground has none. |", markdown.read_text())
        self.assertIn("| SK-AB-2 |", markdown.read_text())
        self.assertIn("12 goals; the sentence says (test)", markdown.read_text())
        rows = list(csv.DictReader(io.StringIO(table.read_text())))
        self.assertEqual([(r["test"], r["part"], r["proof_goals"]) for r in rows if r["requirement"] == "SK-AB-2"],
                         [("Slope.RisesOverTheRun", "", "slope=12"), ("Slope.Steep", "", "slope=12")])
        self.assertEqual([r["part"] for r in rows if r["requirement"] == "IF-W-1"], ["", "the length, in bytes"])
        self.assertIn(f"{table} replaced", self.run_tool("--csv", table).stdout)
        self.assertFalse(list(self.root.glob("*.part")))

    def test_files_that_cannot_be(self):
        pipe = self.root / "pipe"
        os.mkfifo(pipe)
        for place in (self.root / "missing" / "m.md", self.root, pipe):
            done = self.run_tool("--out", place)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
            self.assertIn(str(place), done.stderr)
        self.assertTrue(pipe.is_fifo())
        self.assertEqual(self.run_tool("--id", "SK-AB-1", "--out", self.root / "m.md").returncode, 2)

    def test_inspected(self):
        self.change(CPP, "// verifies: SK-AB-1 to 3", "// verifies: SK-AB-1, 2")
        self.write(LIST, ENTRY.format("SK-AB-3", "safety_kernel/core/slope.c, proofs/goals.json"))
        done = self.run_tool()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.endswith("6 requirements, 5 verified by tests (0 of them in named parts only), 3 of proved units (1 of them say (test)), 1 by inspection\n"))
        self.assertIn("inspect  safety_kernel/core/slope.c, proofs/goals.json  Nothing runs.", done.stdout)

    # What it refuses.

    def test_tag_of_an_unknown_requirement(self):
        self.change(CPP, "// verifies: SK-AB-2", "// verifies: SK-AB-22")
        self.refused(f"{CPP}:11: Slope.Steep verifies SK-AB-22, which is no requirement")

    def test_range_over_an_unknown_requirement(self):
        self.change(CPP, "SK-AB-1 to 3", "SK-AB-1 to SK-AB-5")
        self.refused(f"{CPP}:2: Slope.RisesOverTheRun verifies SK-AB-5, which is no requirement")

    def test_requirement_defined_twice(self):
        self.write("interface_spec/wire/WIRE.md", GOOD["interface_spec/wire/WIRE.md"] + "- **IF-W-1** Again.\n")
        self.refused("interface_spec/wire/WIRE.md:5: IF-W-1 is defined twice: interface_spec/wire/WIRE.md:3 has it as well")

    def test_requirement_that_looks_like_none(self):
        self.change(DOC, "- **SK-AB-3** Nothing", "- **SK-AB-3:** Nothing")
        self.refused(f"{DOC}:8: neither text nor requirement: a requirement is '- **NAME** text'",
                     f"{CPP}:2: Slope.RisesOverTheRun verifies SK-AB-3, which is no requirement")

    def test_requirement_without_source(self):
        self.change(DOC, "`core/slope.h` decides.", "It decides.")
        self.refused(*(f"{DOC}:{line}: SK-AB-{n}: neither its section nor the document's head names a source" for n, line in ((1, 5), (2, 7), (3, 8))),
                     "proofs/goals.json:1: safety_kernel/core/slope is proved, and no requirement names it as its source")

    def test_requirement_without_test(self):
        self.change(CPP, "SK-AB-1 to 3", "SK-AB-1")
        self.refused(f"{DOC}:8: SK-AB-3 is verified by no test, and is not listed as inspected")

    def test_no_requirements(self):
        for name in (DOC, "interface_spec/wire/WIRE.md", CPP, "tests/system/wire/wire_test.py", "proofs/goals.json"):
            (self.root / name).unlink()
        self.refused("safety_kernel/requirements:1: no requirements found")

    def test_tag_that_no_test_follows(self):
        self.write(CPP, GOOD[CPP] + "\n// verifies: SK-AB-1\nint helper();\n// verifies: SK-AB-2\n")
        self.refused(f"{CPP}:14: no test follows this tag", f"{CPP}:16: no test follows this tag")

    def test_blank_line_parts_a_tag_from_its_test(self):
        self.change(CPP, "// Why it is so.\n", "\n")
        self.refused(f"{CPP}:2: no test follows this tag", *(f"{DOC}:{line}: SK-AB-{n} is verified by no test, and is not listed as inspected" for n, line in ((1, 5), (3, 8))))

    def test_disabled_test(self):
        self.change(CPP, "TEST(Slope, Steep)", "TEST(Slope, DISABLED_Steep)")
        self.refused(f"{CPP}:11: no test follows this tag: Slope.DISABLED_Steep is disabled")

    def test_file_that_is_not_built(self):
        self.write("tests/unit/slope/CMakeLists.txt", "add_executable(test_slope other_test_slope.cpp) # test_slope.cpp\n")
        lines = [f"{CPP}:{n}: no test follows this tag: slope/CMakeLists.txt does not build test_slope.cpp" for n in (2, 7, 11)]
        self.refused(*lines, *(f"{DOC}:{line}: SK-AB-{n} is verified by no test, and is not listed as inspected" for n, line in ((1, 5), (2, 7), (3, 8), (4, 14))))

    def test_script_that_no_test_runs(self):
        self.write("tests/system/wire/CMakeLists.txt", "# add_system_test(system_wire wire_test.py)\n")
        script = "tests/system/wire/wire_test.py"
        self.refused(*(f"{script}:{n}: no test follows this tag: CMakeLists.txt has no test of this script" for n in (3, 7, 11)),
                     "interface_spec/wire/WIRE.md:4: IF-W-2 is verified by no test, and is not listed as inspected")

    def test_function_that_nothing_runs(self):
        self.change("tests/system/wire/wire_test.py", "main([words])", "main([])")
        self.refused("tests/system/wire/wire_test.py:7: no test follows this tag: nothing runs words")

    def test_python_tag_before_no_test(self):
        self.change("tests/system/wire/wire_test.py", "TEXT =", "# verifies: IF-W-1\nTEXT =")
        self.refused("tests/system/wire/wire_test.py:10: no test follows this tag")

    def test_malformed_tags(self):
        for text, fault in (("SK-AB-1, and more", "'and more' is no identifier, nor a range of them"), ("SK-AB-1,", "an identifier is missing"),
                            ("SK-AB-1 SK-AB-2", "'SK-AB-1 SK-AB-2' is no identifier, nor a range of them"), ("3", "'3' follows no identifier"),
                            ("SK-AB-1-3", "'SK-AB-1-3' is no identifier, nor a range of them"), ("SK-AB-1 to IF-W-2", "'SK-AB-1 to IF-W-2' goes from one series to another")):
            with self.subTest(text):
                self.write(CPP, GOOD[CPP] + f"\n// verifies: {text}\nTEST(Slope, More) {{}}\n")
                self.refused(f"{CPP}:14: malformed tag: {fault}")

    def test_tags_that_would_be_overlooked(self):
        for line in ("// Verifies: SK-AB-1", "// verifies SK-AB-1", "//verifies:SK-AB-1", "// verify: SK-AB-1"):
            with self.subTest(line):
                self.write(CPP, GOOD[CPP] + f"\n{line}\nTEST(Slope, More) {{}}\n")
                self.refused(f"{CPP}:14: malformed tag: '{line[2:].strip()}' is not 'verifies: NAME, NAME'")
        self.write(CPP, GOOD[CPP] + "\n/* verifies: SK-AB-1 */\nTEST(Slope, More) {}\n")
        self.refused(f"{CPP}:14: malformed tag: not in a line comment")
        self.write(CPP, GOOD[CPP] + "\n// verifies the slope by hand: 1 over 2\nTEST(Slope, More) {}\n")
        self.assertEqual(self.run_tool().returncode, 0)

    def test_range_that_goes_backwards(self):
        for text in ("SK-AB-3 to SK-AB-1", "SK-AB-2 to 1", "SK-AB-2 to 2"):
            with self.subTest(text):
                self.write(CPP, GOOD[CPP] + f"\n// verifies: {text}\nTEST(Slope, More) {{}}\n")
                self.refused(f"{CPP}:14: malformed tag: '{text}' goes backwards")

    def test_inspected_though_unknown(self):
        self.write(LIST, ENTRY.format("SK-AB-9", DOC))
        self.refused(f"{LIST}:1: SK-AB-9 is listed as inspected, and is no requirement")

    def test_inspected_though_tested(self):
        self.write(LIST, "# Why.\n" + ENTRY.format("SK-AB-1", DOC))
        self.refused(f"{LIST}:2: SK-AB-1 is listed as inspected, and Slope.RisesOverTheRun ({CPP}:2) verifies it")

    def test_inspected_list_is_malformed(self):
        self.change(CPP, "SK-AB-1 to 3", "SK-AB-1, SK-AB-2")
        good, missing = ENTRY.format("SK-AB-3", DOC), f"{DOC}:8: SK-AB-3 is verified by no test, and is not listed as inspected"
        for text, lines in ((good.replace('reason = "Nothing runs."', 'reason = " "'), [f"{LIST}:1: an entry needs exactly id, reason, where", missing]),
                            (good + "more = 1\n", [f"{LIST}:1: an entry needs exactly id, reason, where", missing]),
                            (good + good, [f"{LIST}:5: SK-AB-3 is listed twice"]),
                            (good.replace(DOC, "no/such.c"), [f"{LIST}:1: SK-AB-3: where to look is not there: no/such.c"])):
            with self.subTest(text):
                self.write(LIST, text)
                self.refused(*lines)
        for text in (good.replace("[[requirement]]", "[[requirements]]"), 'requirement = [{id = "SK-AB-3"}]\n'):
            self.write(LIST, text)
            self.refused(f"{LIST}:1: holds something else than entries that begin with a line [[requirement]]", missing)
        self.write(LIST, "[[requirement\n")
        done = self.run_tool()
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.startswith(f"{LIST}:1: cannot be read: "), done.stderr)


if __name__ == "__main__":
    unittest.main()
