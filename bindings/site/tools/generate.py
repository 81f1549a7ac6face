# SPDX-License-Identifier: BSD-3-Clause
"""The pages that are made of what the program and the library say of themselves."""
import json
import subprocess

# Each with the file of the tree that has the same: pages link that file, so that no link is dead where the tree itself
# is read, and the built site leads to the page.
PAGES = {"src/scene/options.inc": "reference/options.md", "src/law/law_parameters.cpp": "reference/laws.md",
         "bindings/cli/src/scene/table/scene_keys.cpp": "reference/scene-keys.md",
         "bindings/python/notebooks/first_steps.ipynb": "notebook/first_steps.md"}


def asked(build, *words):
    done = subprocess.run([f"{build}/bin/delam", *words], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def cell(text):
    """A text as it stands in a table of Markdown."""
    words = " ".join(str(text).split())
    for letter in "\\`*_|$<>[]{}~#":
        words = words.replace(letter, "\\" + letter)
    return words


def table(titles, rows):
    lines = ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def described(row):
    default = f"; default {cell(row['default'])}" if row["default"] != "" else ""
    unit = f", {cell(row['unit'])}" if row["unit"] not in ("", "-") else ""
    alias = f" (alias `{row['alias']}`)" if row.get("alias") else ""
    return [f"`{row['key']}`{alias}", cell(row["type"]) + unit, cell(row["range"]) + default, cell(row["meaning"])]


def options(said):
    rows = [described(row) for row in said["options"]]
    return (f"# Options of the solver\n\nWhat `delam options --json` of version {said['version']} says. "
            "A scene sets them in `[solver]`, a program by `delam_problem_set_number` or `delam_problem_set_text`, "
            "before it creates the solver.\n\n"
            + table(["key", "type", "range and default", "meaning"], rows))


def laws(said):
    parts = [f"# Parameters of the laws\n\nWhat `delam options --json` of version {said['version']} says. "
             "A scene sets them in `[[laws]]`, a program by `delam_law_set`. Units: F force, L length.\n"]
    for law in said["laws"]:
        rows = [described(row) for row in law["parameters"]]
        parts.append(f"## {law['kind']}\n\n{cell(law['meaning'])}.\n\n"
                     + table(["key", "type", "range and default", "meaning"], rows))
    return "\n".join(parts)


def resolved(schema, part):
    """A part of the schema with what it refers to."""
    if "$ref" in part:
        return resolved(schema, schema["definitions"][part["$ref"].rsplit("/", 1)[-1]])
    for inner in part.get("allOf", []):
        if "$ref" in inner:
            return {**resolved(schema, inner), **{key: part[key] for key in part if key != "allOf"}}
    return part


def allowed(schema, part):
    """Type and range of a value, in words."""
    part = resolved(schema, part)
    if "enum" in part:
        return ", ".join(f"`{value}`" for value in part["enum"])
    if "anyOf" in part or "oneOf" in part:
        return " or ".join(dict.fromkeys(allowed(schema, one) for one in part.get("anyOf") or part["oneOf"]))
    kind = part.get("type", "")
    kind = kind if isinstance(kind, str) else " or ".join(kind)
    words = {"string": "text", "number": "number", "integer": "whole number", "boolean": "`true` or `false`",
             "object": "table", "array": "list"}.get(kind, kind)
    if kind == "array" and isinstance(part.get("items"), dict):
        words += f" of {allowed(schema, part['items'])}"
    bounds = []
    for key, sign, strict in (("minimum", ">", "exclusiveMinimum"), ("maximum", "<", "exclusiveMaximum")):
        if key in part:
            bounds.append(cell(f"{sign if part.get(strict) else sign + '='} {part[key]:g}"))
    return " ".join([words, " and ".join(bounds)]).strip()


def scene_keys(schema):
    parts = ["# Keys of a scene, from the schema\n\nWhat `delam schema` prints, table by table. The words and rules "
             "behind them are in [the description of scene files](../cli/SCENE.md).\n"]
    for name, part in schema["properties"].items():
        inner = resolved(schema, part)
        title = f"[[{name}]]" if inner.get("type") == "array" else f"[{name}]"
        if inner.get("type") == "array":
            inner = resolved(schema, inner["items"])
        if "properties" not in inner:
            parts.append(f"## {name}\n\n{cell(part.get('description', ''))}: {allowed(schema, part)}.\n")
            continue
        required = set(inner.get("required", []))
        rows = [[f"`{key}`" + (" *" if key in required else ""), allowed(schema, value),
                 cell(value.get("description", resolved(schema, value).get("description", "")))]
                for key, value in inner["properties"].items()]
        parts.append(f"## {cell(title)}\n\n{cell(part.get('description', ''))}.\n\n"
                     + table(["key (* required)", "value", "meaning"], rows))
    return "\n".join(parts)


def pages(build):
    """{name: text} of PAGES, but for the notebook."""
    said, schema = asked(build, "options", "--json"), asked(build, "schema")
    scene = scene_keys(schema).replace("(../cli/SCENE.md)", "(../tree/bindings/cli/SCENE.md)")
    return dict(zip(PAGES.values(), (options(said), laws(said), scene)))


def documents(names, source):
    """The page that leads to every document of the tree."""
    rows = []
    for name in names:
        text = (source / name).read_text(encoding="utf-8")
        title = next((line[2:].strip() for line in text.splitlines() if line.startswith("# ")), str(name))
        rows.append(f"- [{title}]({name}): `{name.relative_to('tree')}`")
    listed = "\n".join(rows)
    tree = "\n".join(map(str, names))
    return ("# Documents of the tree\n\nEach is read from where it is in the sources; here are all that some page of "
            f"this site links.\n\n{listed}\n\n```{{toctree}}\n:hidden:\n\n{tree}\n```\n")
