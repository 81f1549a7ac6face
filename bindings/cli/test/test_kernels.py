# SPDX-License-Identifier: BSD-3-Clause
"""The program has kernels of OpenBLAS that suit the processor, those that the user names, and all of its arguments."""
import os
import re
import subprocess
import sys

from support import DELAM, expect, finish

OLD = ("Prescott", "Core2", "Penryn", "Dunnington", "Nehalem", "Sandybridge", "Barcelona", "Bulldozer")


def kernels(*words, **chosen):
    """The kernels that OpenBLAS says it takes, each time that it is loaded, and the answer of the program."""
    env = {key: value for key, value in os.environ.items() if key != "OPENBLAS_CORETYPE"}
    done = subprocess.run([DELAM, *words], env={**env, "OPENBLAS_VERBOSE": "2", **chosen}, capture_output=True, text=True,
                          timeout=60, check=False)
    return re.findall(r"^Core: (\w+)$", done.stderr + done.stdout, re.M), done


with open("/proc/cpuinfo", encoding="utf-8") as file:
    modern = re.search(r"\bavx2\b", file.read()) is not None
taken, done = kernels("options")
if not taken or not modern:
    print("no OpenBLAS that tells its kernels, or no processor with AVX2")
    sys.exit(77)
expect(taken[-1] not in OLD and len(taken) <= 2, f"those of the processor: {taken}")
expect(done.returncode == 0 and "kinematics" in done.stdout, "the command is carried out")
taken, _ = kernels("options", OPENBLAS_CORETYPE="Prescott")
expect(taken == ["Prescott"], f"those that are named: {taken}")
_, done = kernels("check", "no such scene.toml")
expect(done.returncode == 2 and "no such scene.toml" in done.stderr, f"arguments with blanks: {done.stderr}")
finish()
