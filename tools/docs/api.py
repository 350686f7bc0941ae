"""The Python package's reference as a page: signatures and docstrings of its sources, which are parsed and not imported."""

import ast
import re

MODULES = ("log", "estimate", "robot", "friction", "mujoco_attach", "mujoco_bound", "native_springs", "friction_arrays", "reference", "engine")  # in the order of work


def reference(package):
    """The page for the package in a folder. Exits, naming it, where something public has no docstring or is in none of MODULES."""
    init = ast.parse((package / "__init__.py").read_text())
    public = next(set(ast.literal_eval(node.value)) for node in init.body if isinstance(node, ast.Assign))
    lines = ["# Python reference", "", *described(ast.get_docstring(init))]
    for module in MODULES:
        source = (package / f"{module}.py").read_text()
        tree = ast.parse(source)
        lines += ["", f"## {ast.get_docstring(tree).splitlines()[0].rstrip('.')}"]
        for node in tree.body:
            if is_shown(node, public):
                lines += entry(node, source)
                public.discard(node.name)

    # of the extension come errors and the version alone, of which the first words speak
    extension = {name.asname or name.name for node in init.body if isinstance(node, ast.ImportFrom) and node.module == "warmjoint._core"
                 for name in node.names}
    if public - extension:
        raise SystemExit(f"error: {', '.join(public - extension)} of warmjoint is in none of {MODULES}, of which tools/docs/api.py tells")
    return "\n".join(lines) + "\n"


def is_shown(node, public):
    """Public functions, and classes that people meet: those that are public or that public functions return."""
    if isinstance(node, ast.ClassDef):
        return not node.name.startswith("_") and "Protocol" not in map(ast.unparse, node.bases)
    return isinstance(node, ast.FunctionDef) and node.name in public and "overload" not in map(ast.unparse, node.decorator_list)


def entry(node, source):
    """The lines of a class or a function, with those of what a class holds."""
    text = ast.get_docstring(node)
    if text is None:
        raise SystemExit(f"error: warmjoint's {node.name} has no docstring, which the reference shows")
    lines = ["", f"### {node.name}", ""]
    if isinstance(node, ast.FunctionDef):
        return [*lines, "```python", signature(node), "```", "", *described(text)]
    fields = [part for part in node.body if isinstance(part, ast.AnnAssign)]
    begins = [part for part in node.body if isinstance(part, ast.FunctionDef) and part.name == "__init__"]
    shown = [signature(part).replace("__init__", node.name).removesuffix(" -> None") for part in begins]
    # fields with their comments
    shown += [source.splitlines()[part.lineno - 1].strip() for part in fields if not begins]
    lines += ["```python", *shown, "```", ""] if shown else []
    lines += described(text)
    for part in node.body:
        if not isinstance(part, ast.FunctionDef) or part.name.startswith("_"):
            continue
        about = ast.get_docstring(part) or ""
        if part.decorator_list and "property" in map(ast.unparse, part.decorator_list):
            lines += ["", f"`{signature(part)}`: {about}" if about else f"`{signature(part)}`"]
        else:
            lines += ["", "```python", signature(part), "```", "", *described(about)]
    return lines


def signature(node):
    """A function's name with its arguments; of a property its name and type."""
    decorators = [ast.unparse(one) for one in node.decorator_list]
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    if "property" in decorators:
        return node.name + returns.replace(" ->", ":")
    arguments = ast.unparse(node.args).removeprefix("self").removeprefix("cls").removeprefix(", ")
    line = f"{node.name}({arguments}){returns}"
    # a long one has a line for each argument; commas between brackets part none
    return line if len(line) <= 100 else f"{node.name}(\n    " + re.sub(r", (?=[*\w]+(?:[:,=]|$))", ",\n    ", arguments) + f"){returns}"


def described(text):
    """A docstring as Markdown: what begins with an argument's name and a colon becomes an item of a list."""
    lines = []
    for line in text.splitlines():
        argument = re.match(r"(\w+): (.*)", line)
        if (argument or line.startswith(("Returns ", "Raises "))) and lines and lines[-1]:
            lines.append("")
        lines.append(f"- `{argument[1]}`: {argument[2]}" if argument else line)
    return lines
