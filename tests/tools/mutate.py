"""What tools/mutate changes, and what it leaves alone. Oracle: changes written out by hand.

Usage: python3 tests/tools/mutate.py
"""

import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("mutate", str(ROOT / "tools" / "mutate"))
mutate = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", loader))
sys.modules["mutate"] = mutate
loader.exec_module(mutate)


def changes(text: str) -> set[tuple[str, str]]:
    return {(mutant.kind, mutant.after) for mutant in mutate.mutants_of("core/a.cpp", text)}


class Changes(unittest.TestCase):
    def test_comparisons_are_turned_and_their_bounds_moved(self) -> None:
        self.assertEqual(changes("if (a < b) {"), {("comparison", "if (a >= b) {"), ("bound", "if (a <= b) {")})
        self.assertEqual(changes("if (a != b) {"), {("comparison", "if (a == b) {")})

    def test_signs_factors_logic_and_extremes(self) -> None:
        self.assertEqual(changes("const T x = a + b * c;"),
                         {("sign", "const T x = a - b * c;"), ("factor", "const T x = a + b / c;")})
        self.assertEqual(changes("const T x = -a;"), {("sign", "const T x = a;")})
        self.assertEqual(changes("if (a && !b) {"), {("logic", "if (a || !b) {"), ("logic", "if (a && b) {")})
        self.assertEqual(changes("const T x = std::max(a, b);"), {("extreme", "const T x = std::min(a, b);")})

    def test_constants(self) -> None:
        for number, other in (("7", "8"), ("20'000", "20001"), ("0.5", "0.505"), ("1.0", "1.01"), ("100.0", "101.0"),
                              ("0.0", "1.0"), ("1e-9", "1e-6"), ("2.5e10", "2.5e13")):
            self.assertEqual(changes(f"const T x = {number};"), {("constant", f"const T x = {other};")})
        self.assertEqual(changes("Matrix<2, 3> x1_0;"), set())

    def test_values_returned(self) -> None:
        self.assertEqual(changes("  return area(p);"), {("returned", "  return {};")})
        for same in ("return {};", "return nullptr;", "return std::nullopt;"):
            self.assertEqual(changes(same), set())

    def test_statements_left_out(self) -> None:
        for statement, without in (("  sum += x;", "  ;"), ("  p.values[i] = x;", "  ;"), ("  ++count;", "  ;"),
                                   ("  list.clear();", "  ;"), ("  if (f(a)) list.clear();", "  if (f(a)) ;"),
                                   ("  for (T a : b) c(a);", "  for (T a : b) ;"), ("  else c(a);", "  else ;"),
                                   ("  if (a) continue;", "  if (a) ;"), ("  throw Failure(a);", "  ;")):
            self.assertIn(("left out", without), changes(statement), statement)
        for whole in ("  const T x = f(a);", "  T x(a);", "  Bridge();", "  int area(T a);", "  return f(a);",
                      "  if (f(a)) {", "  f(a,"):
            self.assertNotIn("left out", {kind for kind, _ in changes(whole)}, whole)
        self.assertNotIn("left out", {kind for kind, _ in changes("  T x = a +\n      f(b);")})  # a part of one

    def test_comments_texts_and_the_preprocessor_are_left_alone(self) -> None:
        for text in ("// a < b + 1", "/* a < b\n + 1 */", '#include "a < 1"', "#if a < 1 \\\n && b < 2",
                     'f("a < b + 1",', "f('+',", 'f(R"(a < "b" + 1)",', "using A = B<1 + 2>;",
                     "static_assert(a < 1 + 2);"):
            self.assertEqual(changes(text), set(), text)

    def test_every_mutant_of_the_sources_changes_code_and_one_line_only(self) -> None:
        seen = set()
        for folder in mutate.FOLDERS:
            for kind, mutants in mutate.by_kind(folder).items():
                seen.add(kind)
                for mutant in mutants:
                    self.assertNotEqual(mutant.before, mutant.after)
                    self.assertNotIn("\n", mutant.after)
        self.assertEqual(seen, {kind for kind, _, _ in mutate.RULES} | {"left out"})


class Choice(unittest.TestCase):
    def test_a_seed_stands_for_the_same_mutants_and_folders_take_turns(self) -> None:
        chosen = mutate.choose(list(mutate.FOLDERS), 1, 40)
        self.assertEqual(chosen, mutate.choose(list(mutate.FOLDERS), 1, 40))
        self.assertNotEqual(chosen, mutate.choose(list(mutate.FOLDERS), 2, 40))
        self.assertEqual([mutant.path.split("/")[0] for mutant in chosen[:4]], list(mutate.FOLDERS))
        self.assertEqual(len(set(chosen)), 40)

    def test_a_folder_that_runs_out_is_no_endless_search(self) -> None:
        every = mutate.choose(["core/error.h"], 1, 10_000)
        self.assertEqual(len(every), len(set(every)))


class Trial(unittest.TestCase):
    def test_the_copy_is_as_before_whatever_happens_to_the_mutant(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            copy = mutate.Copy(Path(folder), 1)
            file = Path(folder) / "core" / "a.cpp"
            file.parent.mkdir()
            file.write_text("a;\nreturn b;\n")
            seen = []

            def interrupted(_: str) -> None:
                seen.append(file.read_text())
                raise KeyboardInterrupt

            copy.first_failure = interrupted
            with self.assertRaises(KeyboardInterrupt):
                copy.try_mutant(mutate.Mutant("core/a.cpp", 2, "returned", "return b;", "return {};"))
            self.assertEqual(seen, ["a;\nreturn {};\n"])
            self.assertEqual(file.read_text(), "a;\nreturn b;\n")

    def test_a_program_that_does_not_end_is_ended_with_its_children(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            code, _ = mutate.run(["bash", "-c", "sleep 600 & wait"], Path(folder), 0.2)
            self.assertIsNone(code)
            self.assertEqual(mutate.run(["bash", "-c", "echo $TMPDIR; exit 3"], Path(folder)),
                             (3, f"{folder}/build/tmp\n"))


if __name__ == "__main__":
    unittest.main()
