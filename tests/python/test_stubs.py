"""The stub of the compiled part says what is there."""

import ast
import inspect
import pathlib

import pytest

import adstar
from adstar import _core

STUB = ast.parse(pathlib.Path(adstar.__file__).with_name("_core.pyi").read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def parameters_of(compiled):
    """pybind11 writes the signature as the first line of the docstring: `step(self: Body, h_s: float) -> bool`."""
    line = compiled.__doc__.splitlines()[0]
    return list(ast.parse(f"def {line.split(' -> ')[0]}: ...".replace("adstar._core.", "")).body[0].args.args)


def named(arguments):
    return [argument.arg for argument in arguments]


def classes():
    return {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}


def functions():
    return {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}


def test_has_the_names_of_the_module():
    assert set(classes()) | set(functions()) == public(vars(_core))
    assert isinstance(_core.__version__, str)


@pytest.mark.parametrize("name", functions())
def test_has_the_parameters_of(name):
    assert named(functions()[name].args.args) == named(parameters_of(getattr(_core, name)))


@pytest.mark.parametrize("name", classes())
def test_has_the_members_of(name):
    compiled, node = getattr(_core, name), classes()[name]
    members = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}
    own = {key: value for key, value in vars(compiled).items() if key == "__init__" or not key.startswith("_")}
    if issubclass(compiled, Exception):
        assert not members and [base.id for base in node.bases] == [compiled.__bases__[0].__name__]
        return
    assert set(members) | {"__init__"} == set(own) | {"__init__"}
    for member, function in members.items():
        decorators = named_decorators(function)
        if "property" in decorators:
            assert isinstance(own[member], property), member
        else:
            assert named(function.args.args) == named(parameters_of(getattr(compiled, member))), member
            assert ("staticmethod" in decorators) == isinstance(own[member], staticmethod), member


def named_decorators(function):
    return {decorator.id for decorator in function.decorator_list}


def test_everything_public_is_documented_and_typed():
    assert pathlib.Path(adstar.__file__).with_name("py.typed").exists()
    for name in adstar.__all__:
        value = getattr(adstar, name)
        if name == "__version__":
            continue
        assert inspect.getdoc(value), name
        if inspect.isfunction(value):
            signature = inspect.signature(value)
            annotations = [parameter.annotation for parameter in signature.parameters.values()]
            assert inspect.Signature.empty not in [*annotations, signature.return_annotation], name
