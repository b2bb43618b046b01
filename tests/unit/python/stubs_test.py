# SPDX-License-Identifier: BSD-3-Clause
"""The stubs name what is there, and the examples are typed."""

import ast
import inspect
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import edgevo
import scene
import tutorial

STUBS = scene.ROOT / "modules/python/edgevo/__init__.pyi"
EXAMPLES = scene.ROOT / "share/examples/python"


def names_in(body: list[ast.stmt]) -> set[str]:
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            names.add(node.target.id)
        elif isinstance(node, ast.Assign):
            names |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return names


def public(names: "set[str] | list[str]") -> set[str]:
    return {name for name in names if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def setUp(self) -> None:
        self.tree = ast.parse(STUBS.read_text())

    def test_the_names_are_those_of_the_module(self) -> None:
        self.assertEqual(public(names_in(self.tree.body)) | {"__version__"}, set(edgevo.__all__))
        self.assertEqual(public(dir(edgevo)), public(edgevo.__all__))

    def test_the_names_are_those_of_each_class(self) -> None:
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                there = getattr(edgevo, node.name)
                inherited = public(dir(ValueError)) | public(dir(int)) if issubclass(there, (ValueError, int)) else set()
                self.assertEqual(public(names_in(node.body)), public(dir(there)) - inherited, node.name)

    def test_everything_is_documented(self) -> None:
        for name in public(edgevo.__all__):
            there = getattr(edgevo, name)
            self.assertTrue(inspect.getdoc(there), name)
            if isinstance(there, type):
                for member in public(list(vars(there))):
                    self.assertTrue(inspect.getdoc(getattr(there, member)), f"{name}.{member}")

    def test_arguments_are_those_of_the_functions(self) -> None:
        functions = {node.name: node for node in self.tree.body if isinstance(node, ast.FunctionDef)}
        for name, node in functions.items():
            stub = [a.arg for a in node.args.args + node.args.kwonlyargs]
            self.assertEqual(stub, list(inspect.signature(getattr(edgevo, name)).parameters), name)

    def test_examples_are_typed(self) -> None:
        if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode != 0:
            self.skipTest("SKIPPED: mypy is not installed")
        with tempfile.TemporaryDirectory() as folder:
            pages = tutorial.write_blocks(pathlib.Path(folder))
            environment = {**os.environ, "MYPYPATH": str(STUBS.parents[1]), "PYTHONPATH": ""}
            # One at a time: each is a program.
            for file in [*sorted(EXAMPLES.glob("*.py")), *pages]:
                done = subprocess.run(
                    [sys.executable, "-m", "mypy", "--config-file", str(pathlib.Path(__file__).with_name("mypy.ini")),
                     "--cache-dir", f"{folder}/cache", str(file)], env=environment, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
