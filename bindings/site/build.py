# SPDX-License-Identifier: BSD-3-Clause
"""Builds the site with Debian's Sphinx from the pages here, the documents of the tree, and the results of the blocks.

    /usr/bin/python3 bindings/site/build.py --build build/release --out build/release/site [--fresh]

OUT/html is the site, which a browser reads without a network. The blocks must have run in OUT/work (run_blocks.py).
"""
import argparse
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parents[1]
sys.path.insert(0, str(SITE / "tools"))

import cpp_reference  # noqa: E402
import generate  # noqa: E402
import notebook  # noqa: E402
from stage import Stage, StageError  # noqa: E402

MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# What formulas by SVG need; all of MathJax is 54 MB.
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG",
                 "localization/en"]


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(delam VERSION (\S+)", text)[1]


def doxygen(out):
    """The header as XML, through the filter that the HTML reference has too."""
    out.mkdir(parents=True, exist_ok=True)
    settings = (ROOT / "verify/abi/Doxyfile").read_text(encoding="utf-8")
    settings += "\nGENERATE_HTML = NO\nGENERATE_XML = YES\n"
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True,
                   env={**os.environ, "DELAM_DOXYGEN_OUTPUT": str(out)})
    for path in (out / "xml").glob("*_8h.xml"):
        tidied(path)
    return out / "xml"


def tidied(path):
    """A struct and the typedef of its name are one thing in C, which Sphinx would declare twice."""
    tree = ElementTree.parse(path)
    structs = {node.text for node in tree.iter("innerclass")}
    for section in tree.iter("sectiondef"):
        for member in section.findall("memberdef[@kind='typedef']"):
            if member.findtext("name") in structs:
                section.remove(member)
    tree.write(path, encoding="utf-8", xml_declaration=True)


def copy_mathjax(target):
    for part in MATHJAX_PARTS:
        source = MATHJAX / part
        if source.is_dir():
            shutil.copytree(source, target / part, dirs_exist_ok=True)
        else:
            (target / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target / part)


def copy_script(target):
    """Furo's script as one file: Debian leaves an import in it, which no browser takes here."""
    folder = pathlib.Path("/usr/lib/python3/dist-packages/furo/assets/scripts")
    parts = [(folder / name).read_text(encoding="utf-8") for name in ("gumshoe-patched.js", "furo.js")]
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(parts[0] + "\n" + re.sub(r"^import .*\n", "", parts[1], flags=re.M), encoding="utf-8")


def staged(given, source):
    """Fills the folder that Sphinx reads."""
    stage = Stage(ROOT, SITE, source, given.work or given.out / "work")
    pages = generate.pages(given.build)
    stage.generated = generate.PAGES
    stage.gather()
    for name, text in pages.items():
        stage.put(name, text)
    notebook.convert(ROOT / "bindings/python/notebooks/first_steps.ipynb", source / "notebook", given.build,
                     {"DELAM_LIBRARY": f"{given.build}/lib", "PYTHONPATH": str(ROOT / "bindings/python/src")})
    documents = [name for path, name in stage.documents.items() if stage.pages not in path.parents]
    stage.put("documents.md", generate.documents(sorted(documents, key=str), source))
    shutil.copytree(SITE / "static", source / "_static")
    copy_mathjax(source / "_static/mathjax")
    copy_script(source / "_static/scripts/furo.js")
    return stage


def sphinx(given, source, html):
    os.environ.setdefault("DELAM_LIBRARY", f"{given.build}/lib")
    sys.path.insert(0, str(ROOT / "bindings/python/src"))
    from sphinx.cmd.build import build_main
    return build_main(["-W", "--keep-going", "-q", "-j", str(given.jobs), "-c", str(SITE), "-d",
                       str(given.out / "doctrees"), "-b", "html", str(source), str(html)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, help="where the blocks have run (default OUT/work)")
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    missing = [name for name in ("sphinx", "myst_parser", "breathe", "furo", "nbclient", "matplotlib_inline")
               if importlib.util.find_spec(name) is None]
    missing += [name for name in ("doxygen",) if shutil.which(name) is None]
    missing += [str(path) for path in (MATHJAX,) if not path.is_dir()]
    if missing:
        print(f"skipped: missing: {', '.join(missing)} (verify/packages.sh: DELAM_SITE_PACKAGES)")
        return 77
    given.build, given.out = given.build.resolve(), given.out.resolve()
    began = time.monotonic()
    source, html = given.out / "source", given.out / "html"
    shutil.rmtree(html, ignore_errors=True)
    shutil.rmtree(given.out / "doctrees", ignore_errors=True)
    try:
        stage = staged(given, source)
    except StageError as error:
        print(error, file=sys.stderr)
        return 1
    os.environ["DELAM_SITE_VERSION"] = version()
    os.environ["DELAM_SITE_STATIC"] = str(source / "_static")
    c_xml = doxygen(given.out / "doxygen")
    os.environ["DELAM_SITE_XML"] = str(c_xml)
    try:
        os.environ["DELAM_SITE_XML_CPP"] = str(
            cpp_reference.made(given.out / "doxygen_cpp", c_xml, SITE / "pages/reference/cpp.md"))
    except cpp_reference.Undocumented as error:
        print(f"bindings/cpp/include: {error}", file=sys.stderr)
        return 1
    code = sphinx(given, source, html)
    pages = len(list(html.rglob("*.html")))
    documents = sum(stage.pages not in path.parents for path in stage.documents)
    print(f"{pages} pages, {documents} of them from documents, {len(stage.files)} files, "
          f"{stage.links['inside']} links inside, {time.monotonic() - began:.0f} s: {html}/index.html")
    return code


if __name__ == "__main__":
    sys.exit(main())
