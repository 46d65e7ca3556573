"""Tags in Python: in the docstring of a script or of a test, or in comments before a test, or before the call that runs the script's tests."""
import ast
import io
import tokenize

from comments import tags_of
from registered import script_test


def nodes_with_docstring(tree):
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and node.body:
            first = node.body[0]
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
                yield node, first.value


def docstring_lines(source, value):
    lines = source[value.lineno - 1:value.end_lineno]
    return [(value.lineno + i, line.replace('"""', " ")) for i, line in enumerate(lines)]


def comment_blocks(text):
    """[[(line number, text)]] of the comments that stand alone on their lines, consecutive ones together."""
    blocks = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and not token.line[:token.start[1]].strip():
            number = token.start[0]
            if blocks and blocks[-1][-1][0] == number - 1:
                blocks[-1].append((number, token.string.lstrip("# ")))
            else:
                blocks.append([(number, token.string.lstrip("# "))])
    return blocks


def name_of_test(tree, text, script, node):
    """The test that a tag before or in this node is of: a function, a class, or, by a call or a docstring of the whole, the script."""
    if script is None:
        return None, "CMakeLists.txt has no test of this script"
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        used = any(isinstance(n, ast.Name) and n.id == node.name for n in ast.walk(tree)) or node.name.startswith("test") or isinstance(node, ast.ClassDef)
        return (f"{script}:{node.name}", "") if used else (None, f"nothing runs {node.name}")
    whole = isinstance(node, ast.Module) or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call))
    return (script, "") if whole else (None, "")


def read_python(path):
    text = path.read_text()
    tree, script, found = ast.parse(text), script_test(path), []
    for node, value in nodes_with_docstring(tree):
        found += [(tag, node) for tag in tags_of(docstring_lines(text.splitlines(), value))]
    statements = {n.lineno: n for n in ast.walk(tree) if isinstance(n, ast.stmt)}
    for block in comment_blocks(text):
        found += [(tag, statements.get(block[-1][0] + 1)) for tag in tags_of(block)]
    for tag, node in found:
        tag.test, tag.why = name_of_test(tree, text, script, node)
    return [tag for tag, _ in found]
