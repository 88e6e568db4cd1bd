"""What in a text needs a Python newer than 3.8, which some builds of FreeCAD 0.20 have."""

import ast

__all__ = ["newer"]

#: Classes that take a subscript since 3.9, beside those of `collections`.
_GENERIC = {"dict", "frozenset", "list", "set", "tuple", "type"}

#: Methods and functions that came later, of what such code uses.
_LATER = {
    *("batched", "bit_count", "cache", "files", "hardlink_to", "is_relative_to", "lcm", "pairwise"),
    *("randbytes", "readlink", "removeprefix", "removesuffix", "unparse", "walk_up", "with_stem"),
}

_DICTS = (ast.Dict, ast.DictComp)


def newer(text):
    """What is done when the text runs, or how it is written, that 3.8 does not know."""
    tree = ast.parse(text, feature_version=(3, 8))
    generic = _GENERIC | {
        alias.asname or alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in ("collections", "collections.abc")
        for alias in node.names
    }
    late = any(isinstance(n, ast.ImportFrom) and n.module == "__future__" for n in tree.body)
    nodes = ast.walk(_Bare().visit(tree) if late else tree)
    return [ast.unparse(node) for node in nodes if _is_newer(node, generic)]


class _Bare(ast.NodeTransformer):
    """Leaves out annotations, which nothing looks at when they stay text."""

    def visit_arg(self, node):
        node.annotation = None
        return node

    def visit_FunctionDef(self, node):
        node.returns = None
        return self.generic_visit(node)

    def visit_AnnAssign(self, node):
        return self.visit(node.value) if node.value else ast.Pass()


def _is_newer(node, generic):
    if isinstance(node, ast.Subscript):
        return isinstance(node.value, ast.Name) and node.value.id in generic
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
        return isinstance(node.left, _DICTS) or isinstance(node.right, _DICTS)
    if isinstance(node, ast.Call):
        return any(word.arg == "strict" for word in node.keywords)
    name = getattr(node, "attr", getattr(node, "name", ""))
    return isinstance(node, ast.Attribute | ast.alias) and name in _LATER
