"""The readable loop made the fast loop: ``for h in outgoing(t, v)`` becomes a guarded ``while``.

Numba can run a generator inside a compiled loop, but it keeps the generator's state in memory and pays for it at
every step. A circulator is nothing but a first element, a step and the rule to stop, so `unrolled` writes that
loop out in the syntax tree before the function is compiled::

    for h in outgoing(t, v):            _t = t
        body                            _end = _start(_t, v)
                                        _at = _end
                                        _more = _at >= 0
                                        while _more:
                                            h = _value(_t, _at)
                                            _at = _step(_t, _at)
                                            _more = _at != _end
                                            body

The step is taken *before* the body runs, here and in the interpreted generator, so that ``continue`` needs no care
and both gears agree even when the body changes the mesh. Line numbers are kept: errors and debuggers point at
the user's own text.
"""

from __future__ import annotations

import ast
import copy
import difflib
import inspect
import textwrap
import types
from typing import Any

__all__ = ["Loop", "inlined", "misspelled", "unrolled", "with_column_reads"]


class Loop:
    """What is unrolled: a loop that is declared by its rules, see `circulators`."""

    start: Any
    step: Any
    value: Any
    skips: bool


def unrolled(function: types.FunctionType) -> types.FunctionType:
    """The function with its circulator loops written out; the function itself where there is none (or no source)."""
    if not _may_circulate(function):
        return function
    tree = _parsed(function)
    if tree is None:
        return function
    rewriter = _Unroller(function)
    rewriter.visit(tree)
    code = _compiled(tree, function)
    if code is None or not rewriter.found:
        return function
    scope = {**function.__globals__, **rewriter.rules}
    return _assembled(function, code, scope)


def with_column_reads(function: types.FunctionType, read: Any) -> types.FunctionType:
    """The function with every ``t.column[i]`` that it reads written as ``read(t.column, i)``."""
    tree = _parsed(function)
    code = None if tree is None else _compiled(_ColumnReads().visit(tree), function)
    return function if code is None else _assembled(function, code, {**function.__globals__, "_read": read})


class _ColumnReads(ast.NodeTransformer):
    def visit_Subscript(self, node: ast.Subscript) -> Any:
        self.generic_visit(node)
        if not isinstance(node.ctx, ast.Load) or not isinstance(node.value, ast.Attribute):
            return node
        call = ast.Call(func=ast.Name(id="_read", ctx=ast.Load()), args=[node.value, node.slice], keywords=[])
        return ast.copy_location(ast.fix_missing_locations(ast.copy_location(call, node)), node)


def misspelled(function: types.FunctionType) -> str:
    """A remark on the first ``module.name`` in the function that the module doesn't have; empty if all are there."""
    tree = _parsed(function)
    for node in ast.walk(tree) if tree is not None else ():
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module = function.__globals__.get(node.value.id)
            if isinstance(module, types.ModuleType) and not hasattr(module, node.attr):
                close = difflib.get_close_matches(node.attr, dir(module), 1)
                meant = f"; did you mean {node.value.id}.{close[0]}?" if close else ""
                return f" Line {node.lineno}: there is no {node.value.id}.{node.attr}{meant}"
    return ""


def inlined(function: types.FunctionType, name: str, rule: types.FunctionType) -> types.FunctionType:
    """The function with its calls of `name` replaced by the one expression that `rule` returns."""
    tree, body = _parsed(function), _parsed(rule)
    if tree is None or body is None:
        return function
    definition = body.body[0]
    assert isinstance(definition, ast.FunctionDef)
    returned = definition.body[-1]
    if not isinstance(returned, ast.Return) or returned.value is None:
        return function
    parameters = [argument.arg for argument in definition.args.args]
    code = _compiled(_Inliner(name, parameters, returned.value).visit(tree), function)
    return function if code is None else _assembled(function, code, dict(function.__globals__))


class _Inliner(ast.NodeTransformer):
    def __init__(self, name: str, parameters: list[str], expression: ast.expr) -> None:
        self.name, self.parameters, self.expression = name, parameters, expression

    def visit_Call(self, node: ast.Call) -> Any:
        self.generic_visit(node)
        if not isinstance(node.func, ast.Name) or node.func.id != self.name:
            return node
        values = dict(zip(self.parameters, node.args, strict=True))
        return _Substitution(values).visit(copy.deepcopy(self.expression))


class _Substitution(ast.NodeTransformer):
    def __init__(self, values: dict[str, ast.expr]) -> None:
        self.values = values

    def visit_Name(self, node: ast.Name) -> Any:
        return copy.deepcopy(self.values[node.id]) if node.id in self.values else node


def _may_circulate(function: types.FunctionType) -> bool:
    return any(isinstance(value, Loop) for value in _reachable(function))


def _reachable(function: types.FunctionType) -> list[Any]:
    names = function.__code__.co_names
    scope = [function.__globals__[name] for name in names if name in function.__globals__]
    scope += [cell.cell_contents for cell in function.__closure__ or ()]
    modules = [value for value in scope if isinstance(value, types.ModuleType)]
    return scope + [getattr(module, name) for module in modules for name in names if hasattr(module, name)]


def _parsed(function: types.FunctionType) -> ast.Module | None:
    """The syntax tree of the function's text, if the text is there and is still the one that was compiled."""
    try:
        lines, first = inspect.getsourcelines(function)
    except (OSError, TypeError):
        return None
    try:
        tree = ast.parse(textwrap.dedent("".join(lines)))
    except SyntaxError:  # e.g. a lambda in the middle of an expression
        return None
    ast.increment_lineno(tree, first - 1)
    definition = tree.body[0]
    if not isinstance(definition, ast.FunctionDef):
        return None
    definition.decorator_list = []
    codes = (_compiled(tree, function, imports) for imports in ((), _modules(function)))
    return tree if any(code is not None and code.co_code == function.__code__.co_code for code in codes) else None


def _modules(function: types.FunctionType) -> tuple[str, ...]:
    """The names that mean modules. Python compiles ``hm.f()`` another way where `hm` is imported in the same text."""
    scope = inspect.getclosurevars(function)
    return tuple(n for n, value in {**scope.globals, **scope.nonlocals}.items() if isinstance(value, types.ModuleType))


def _compiled(tree: ast.Module, function: types.FunctionType, imports: tuple[str, ...] = ()) -> types.CodeType | None:
    """The code object of the definition in `tree`, with the function's closure variables as free variables."""
    wrapper = ast.parse("def _closure():\n    pass")
    outer = wrapper.body[0]
    assert isinstance(outer, ast.FunctionDef)
    free = function.__code__.co_freevars
    outer.args.args = [ast.arg(arg=name) for name in free]
    outer.body = [tree.body[0]]
    wrapper.body += [ast.Import(names=[ast.alias(name=name)]) for name in imports]
    ast.fix_missing_locations(wrapper)
    module = compile(wrapper, function.__code__.co_filename, "exec", dont_inherit=True, flags=_future_flags(function))
    return _inner(_inner(module, "_closure"), function.__name__)


def _future_flags(function: types.FunctionType) -> int:
    import __future__

    flag = __future__.annotations.compiler_flag
    return flag if function.__code__.co_flags & flag else 0


def _inner(code: types.CodeType | None, name: str) -> types.CodeType | None:
    constants = () if code is None else code.co_consts
    return next((c for c in constants if isinstance(c, types.CodeType) and c.co_name == name), None)


def _assembled(function: types.FunctionType, code: types.CodeType, scope: dict[str, Any]) -> types.FunctionType:
    cells = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
    closure = tuple(cells[name] for name in code.co_freevars)
    result = types.FunctionType(code, scope, function.__name__, function.__defaults__, closure)
    result.__kwdefaults__ = function.__kwdefaults__
    result.__qualname__ = function.__qualname__
    result.__module__ = function.__module__
    return result


class _Unroller(ast.NodeTransformer):
    def __init__(self, function: types.FunctionType) -> None:
        self.scope = dict(inspect.getclosurevars(function).nonlocals)
        self.globals = function.__globals__
        self.locals = {*function.__code__.co_varnames}
        self.rules: dict[str, Any] = {}
        self.found = 0

    def visit_For(self, node: ast.For) -> Any:
        self.generic_visit(node)
        rule = self._rule(node.iter)
        if rule is None:
            return node
        assert isinstance(node.iter, ast.Call)
        tag = f"_loop{self.found}"
        self.found += 1
        self.rules[f"{tag}_start"] = rule.start
        self.rules[f"{tag}_step"] = rule.step
        self.rules[f"{tag}_value"] = rule.value
        return self._while(node, node.iter.args, tag, rule)

    def _rule(self, call: ast.expr) -> Loop | None:
        if not isinstance(call, ast.Call) or call.keywords or len(call.args) != 2:
            return None
        value = self._resolved(call.func)
        return value if isinstance(value, Loop) else None

    def _resolved(self, node: ast.expr) -> Any:
        if isinstance(node, ast.Name):
            if node.id in self.locals:
                return None
            return self.scope.get(node.id, self.globals.get(node.id))
        if isinstance(node, ast.Attribute):
            return getattr(self._resolved(node.value), node.attr, None)
        return None

    def _while(self, node: ast.For, arguments: list[ast.expr], tag: str, rule: Loop) -> list[ast.stmt]:
        value = f"{tag}_value({tag}_t, {tag}_at)" if rule.value is not None else f"{tag}_at"
        skip = f"if {tag}_x < 0:\n    continue\n" if rule.skips else ""
        head = _placed(
            f"{tag}_t = T\n{tag}_end = {tag}_start({tag}_t, X)\n{tag}_at = {tag}_end\n{tag}_more = {tag}_at >= 0", node
        )
        turn = _placed(
            f"{tag}_x = {value}\n{tag}_at = {tag}_step({tag}_t, {tag}_at)\n{tag}_more = {tag}_at != {tag}_end\n" + skip,
            node,
        )
        assert isinstance(head[0], ast.Assign)
        assert isinstance(head[1], ast.Assign) and isinstance(head[1].value, ast.Call)
        head[0].value = arguments[0]
        head[1].value.args[1] = arguments[1]
        name, test = (ast.copy_location(ast.Name(id=f"{tag}_{x}", ctx=ast.Load()), node) for x in ("x", "more"))
        element = ast.copy_location(ast.Assign(targets=[node.target], value=name), node)
        loop = ast.While(test=test, body=[*turn, element, *node.body], orelse=node.orelse)
        return [*head, ast.copy_location(loop, node)]


def _placed(text: str, node: ast.AST) -> list[ast.stmt]:
    """Statements that stand, for errors and debuggers, where `node` stands."""
    statements = ast.parse(text).body
    for statement in statements:
        for child in ast.walk(statement):
            ast.copy_location(child, node)
    return statements
