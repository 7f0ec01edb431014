"""The type stubs name what the module has, no more and no less."""

import ast
import pathlib

import tact


def names_in(body):
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return names


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stubs_name_what_the_module_has():
    stubs = ast.parse((pathlib.Path(tact.__file__).parent / "__init__.pyi").read_text())
    module = public(name for name in dir(tact) if not isinstance(getattr(tact, name), type(ast)))
    assert public(names_in(stubs.body)) == module
    for node in stubs.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            found = getattr(tact, node.name)
            # An exception has what RuntimeError has; its code is of the instance.
            members = public(dir(found)) - set(dir(RuntimeError)) | ({"code"} if found is tact.Error else set())
            if hasattr(found, "__members__"):  # dir() leaves out what values of an enumeration have
                members |= {"name", "value"}
            assert public(names_in(node.body)) == members, node.name
