"""Writes the types of obscura: make_stubs.py TEMPLATE OUTPUT.

<NAME> in the template becomes the settings of that function, as the library lists them; the lines
between <each method> and </each method> come once for each method.
"""
import re
import sys

import obscura
from obscura import _settings


def type_of(kind):
    if kind == "text":
        return "_Text"
    if kind in ("bool", "int", "float"):
        return kind
    return "Literal[" + ", ".join(f'"{name}"' for name in kind.split("|")) + "]"


def parameters(name, left_out=()):
    return ", ".join(f"{row[0]}: {type_of(row[5])} = ..." for row in _settings.rows(name)
                     if row[0] not in left_out)


def fill(text):
    def of_methods(match):
        lines = []
        for name in obscura.methods():
            default = " = ..." if name == "far-field" else ""
            lines.append(match.group(1).replace("<method>", f'method: Literal["{name}"]{default}')
                         .replace("<settings>", parameters(name)))
        return "".join(lines)

    text = re.sub(r"^ *<each method>\n(.*?)^ *</each method>\n", of_methods, text,
                  flags=re.DOTALL | re.MULTILINE)

    def settings(match):
        taken = re.findall(r"(\w+):", match.string[match.string.rfind("\n", 0, match.start()):
                                                   match.start()])
        return parameters(match.group(1), taken + ["size"])

    return re.sub(r"<(\w+)>", settings, text)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as f:
        filled = fill(f.read())
    with open(sys.argv[2], "w", encoding="utf-8") as f:
        f.write(filled)
