#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a libFuzzer dictionary of a description of scene files: what stands in it as code, keys with " = " behind."""
import re
import sys

text = open(sys.argv[1], encoding="utf-8").read()
words = set()
for code in re.findall(r"`([^`\n]{1,60})`", text):
    words.add(code)
    words.update(re.findall(r"[A-Za-z_*][A-Za-z0-9_ .*-]{1,40}", code))
for line in re.findall(r"\| ignored \|(.*)", text) + re.findall(r"\| elements \|(.*)", text):
    words.update(re.findall(r"[A-Z][A-Z0-9 ]{3,30}", line))
for word in sorted(words):
    word = word.strip()
    for entry in ([word, word + " = "] if re.fullmatch("[a-z_]+", word) else [word]):
        plain = [chr(b) if 32 <= b < 127 and chr(b) not in '"\\' else f"\\x{b:02x}" for b in entry.encode()]
        print('"' + "".join(plain) + '"')
