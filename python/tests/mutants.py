"""Programs with one mistake, made from a right one: an operator, a comparison, a number or a condition is changed."""

import ast
import copy

ARITHMETIC = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult}
COMPARISONS = {
    ast.Lt: [ast.LtE, ast.Gt],
    ast.LtE: [ast.Lt, ast.GtE],
    ast.Gt: [ast.GtE, ast.Lt],
    ast.GtE: [ast.Gt, ast.LtE],
    ast.Eq: [ast.NotEq],
}
NAMES = {
    "min": "max",
    "max": "min",
    "sin": "cos",
    "cos": "sin",
    "minimum": "maximum",
    "maximum": "minimum",
    "ceil": "floor",
}


def changes(node):
    """What may stand in the place of a node of the syntax tree, wrongly."""
    if isinstance(node, ast.BinOp) and type(node.op) in ARITHMETIC:
        yield ast.BinOp(node.left, ARITHMETIC[type(node.op)](), node.right)
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
        yield node.left
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        for other in COMPARISONS.get(type(node.ops[0]), []):
            yield ast.Compare(node.left, [other()], node.comparators)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Not)):
        yield node.operand
    if isinstance(node, ast.BoolOp):
        yield ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
        for k in range(len(node.values)):
            rest = node.values[:k] + node.values[k + 1 :]
            yield rest[0] if len(rest) == 1 else ast.BoolOp(node.op, rest)
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)) and not isinstance(node.value, bool):
        yield ast.Constant(node.value + 1)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("min", "max", "abs"):
        yield node.args[0]
    if isinstance(node, ast.Name) and node.id in NAMES and isinstance(node.ctx, ast.Load):
        yield ast.Name(NAMES[node.id], ast.Load())
    if isinstance(node, ast.Attribute) and node.attr in NAMES:
        yield ast.Attribute(node.value, NAMES[node.attr], node.ctx)
    if isinstance(node, ast.Attribute) and node.attr == "T":
        yield node.value


class Replaced(ast.NodeTransformer):
    """Puts a change in the place of one node."""

    def __init__(self, node, change):
        self.node, self.change = node, change

    def visit(self, node):
        return self.change if node is self.node else super().generic_visit(node)


def mutants(source, name="mutant"):
    """The changed line, and the function `answer`, of each program that differs in one place from a source."""
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.expr)]
    for place in range(len(nodes)):
        for number in range(len(list(changes(nodes[place])))):
            tree = ast.parse(source)
            node = [node for node in ast.walk(tree) if isinstance(node, ast.expr)][place]
            tree = ast.fix_missing_locations(Replaced(node, list(changes(node))[number]).visit(copy.copy(tree)))
            names = {}
            exec(compile(tree, name, "exec"), names)
            lines = zip(ast.unparse(tree).splitlines(), ast.unparse(ast.parse(source)).splitlines())
            yield next((new.strip() for new, old in lines if new != old), ""), names["answer"]
