#!/usr/bin/env python3
"""Writes the reference pages that the program itself tells: input.md and koshi.schema.json from `koshi schema`,
command-line.md from the help of every command.

usage: docs_reference.py PROGRAM DIRECTORY
"""

import json
import re
import subprocess
import sys
from pathlib import Path

INPUT_HEAD = """# Input

A case is a [TOML](https://toml.io) file. This page is generated from `koshi schema`, the JSON Schema that the program
prints ([koshi.schema.json](koshi.schema.json)); [Editing](../guide/editing.md) says how editors use it.

- A *quantity* is a text with a number and a unit, `"0.2 cm"`, or a bare number in the SI unit given here. The units are
  those of UDUNITS; a unit of the wrong dimension is an error. See [Units](../guide/units.md).
- A key that is not listed here is an error, and so is a key where it has no meaning.
- Lists of tables (`[[region]]`, `[[boundary]]`, `[[load]]`, `[[probe]]`) may have any number of entries.
- `koshi check CASE.toml` prints the case with every default written out.

"""

COMMAND_HEAD = """# Command line

This page is generated from the program's own help. Exit code 0: done; 1: the run failed; 2: bad input or arguments.
Messages name the place: `case.toml:12:9: error: what is wrong, and what would be right`.

"""


def toml(value):
    """A JSON value as TOML text."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(v)}" for key, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    return json.dumps(value, ensure_ascii=False)


def code(text):
    return f"`{text}`" if text else ""


def limits(schema):
    """The range of a number: "> 0", "0 ≤ … < 1"."""
    low, high = "", ""
    if "exclusiveMinimum" in schema:
        low = f"> {schema['exclusiveMinimum']:g}"
    if "minimum" in schema:
        low = f"≥ {schema['minimum']:g}"
    if "exclusiveMaximum" in schema:
        high = f"< {schema['exclusiveMaximum']:g}"
    if "maximum" in schema:
        high = f"≤ {schema['maximum']:g}"
    small = f"0 or at least {schema['smallestSize']:g} in size" if "smallestSize" in schema else ""
    return ", ".join(part for part in (low, high, small) if part)


def kind(schema):
    """What a value looks like, in words."""
    if "enum" in schema:
        return "one of " + ", ".join(code(toml(word)) for word in schema["enum"])
    if "anyOf" in schema:
        return ", or ".join(kind(way) for way in schema["anyOf"])
    type_ = schema["type"]
    if type_ == ["number", "string"]:
        words = f"quantity [{schema['unit']}]" if "unit" in schema else "number"
        return ", ".join(part for part in (words, limits(schema)) if part)
    if type_ == "integer":
        return ", ".join(part for part in ("whole number", limits(schema)) if part)
    if type_ == "array":
        items = schema["items"]
        if "prefixItems" in items:
            return "list of pairs: " + ", ".join(kind(item) for item in items["prefixItems"])
        if schema.get("maxItems") == 3:
            return "three (x, y, z): " + kind(items)
        return "list: " + kind(items) if "enum" in items else "list of texts"
    if type_ == "object":
        if "properties" not in schema:
            return "table: text for each whole number"
        by_kind = {}
        for name, value in schema["properties"].items():
            by_kind.setdefault(kind(value), []).append(code(name))
        return "table: " + "; ".join(f"{', '.join(names)} {words}" for words, names in by_kind.items())
    return {"string": "text", "boolean": "`true` or `false`"}[type_]


def default(name, schema, required):
    if name in required:
        return "required"
    if schema.get("requiredWhereItApplies"):
        return "required where it applies"
    return code(toml(schema["default"])) if "default" in schema else "unset"


def example(name, schema):
    values = schema.get("examples") or schema.get("enum") or [schema.get("default")]
    # A list of words without a better example shows the default; a switch shows the other choice.
    value = not schema["default"] if schema.get("type") == "boolean" else values[0]
    return code(f"{name} = {toml(value)}")


def cell(text):
    return text.replace("|", "\\|")


def key_table(table):
    """The rows of a table of keys, and the nested tables that need a table of their own."""
    lines = ["| key | value | default | meaning | example |", "|---|---|---|---|---|"]
    nested = {}
    for name, schema in table["properties"].items():
        value = kind(schema)
        if name == "damping":
            nested[name] = schema
            value = "table, see below"
        row = [code(name), value, default(name, schema, table.get("required", [])), schema["description"],
               example(name, schema)]  # fmt: skip
        lines.append("| " + " | ".join(cell(text) for text in row) + " |")
    return lines, nested


def input_page(schema):
    lines = [INPUT_HEAD]
    top = {name: table for name, table in schema["properties"].items() if table.get("type") == "string"}
    lines += ["## Top of the file", ""]
    rows, _ = key_table({"properties": top, "required": schema["required"]})
    lines += rows + [""]
    for name, table in schema["properties"].items():
        if name in top:
            continue
        title, keys = f"[{name}]", table
        if "items" in table:
            title, keys = f"[[{name}]]", table["items"]
        elif "properties" not in table:
            title, keys = f"[{name}.NAME]", table["additionalProperties"]
        groups = [[code(key["required"][0]) for key in group["oneOf"]] for group in keys.get("allOf", [])]
        one_of = [f"Exactly one of {', '.join(names)} must be given." for names in groups]
        # Brackets would make a link of the heading.
        lines += [f"## `{title}` {{#{name}}}", "", table["description"], "", " ".join(one_of), ""]
        rows, nested = key_table(keys)
        lines += rows + [""]
        for inner, inner_table in nested.items():
            lines += [f"### `{name}.{inner}` {{#{name}-{inner}}}", "", inner_table["description"], ""]
            lines += key_table(inner_table)[0] + [""]
    return "\n".join(lines)


def help_of(program, *command):
    text = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout
    return "```text\n" + text.strip() + "\n```\n"


def command_page(program):
    text = help_of(program)
    listing = text[text.index("Subcommands:") :]
    commands = re.findall(r"^  ([a-z]+)", listing, re.MULTILINE)
    if not commands:
        raise SystemExit("docs_reference: no subcommands in the help")
    lines = [COMMAND_HEAD, text]
    for command in commands:
        lines += [f"## koshi {command} {{#{command}}}", "", help_of(program, command)]
    return "\n".join(lines)


def main():
    program, directory = sys.argv[1], Path(sys.argv[2])
    directory.mkdir(parents=True, exist_ok=True)
    schema = subprocess.run([program, "schema"], capture_output=True, text=True, check=True).stdout
    (directory / "koshi.schema.json").write_text(schema, encoding="utf-8")
    (directory / "input.md").write_text(input_page(json.loads(schema)), encoding="utf-8")
    (directory / "command-line.md").write_text(command_page(program), encoding="utf-8")


if __name__ == "__main__":
    main()
