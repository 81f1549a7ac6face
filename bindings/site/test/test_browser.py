# SPDX-License-Identifier: BSD-3-Clause
"""test_browser.py HTML: formulas are drawn and scripts run where the site is read from files, without a network.

Skipped (77) without Chromium.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PAGES = {"theory.html": 60, "choosing.html": 25, "tutorial/03-law.html": 5, "index.html": 0}


def opened(browser, page):
    """(text of the page after its scripts, lines of the console, addresses asked for)."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--dump-dom",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={folder}", "--virtual-time-budget=30000",
             page.as_uri()], capture_output=True, text=True, timeout=300, check=True)
    return done.stdout, re.findall(r"CONSOLE.*", done.stderr)


def main():
    browser = shutil.which("chromium")
    if browser is None:
        print("skipped: chromium is not installed")
        return 77
    html, wrong = pathlib.Path(sys.argv[1]).resolve(), []
    for name, formulas in PAGES.items():
        text, console = opened(browser, html / name)
        drawn = len(re.findall(r'<span class="MathJax_SVG"', text))
        left = re.sub(r"<script.*?</script>", "", text, flags=re.S).count("\\(")
        print(f"{name}: {drawn} formulas drawn, {left} left, {len(console)} messages on the console")
        if drawn < formulas or left:
            wrong.append(f"{name}: {drawn} formulas are drawn, {formulas} at least are expected; {left} are left")
        wrong += [f"{name}: {line}" for line in console]
        if 'http://' in "".join(re.findall(r'<(?:script|link|img)[^>]+>', text)).replace("http://www.w3.org", ""):
            wrong.append(f"{name}: asks the network")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
