# SPDX-License-Identifier: BSD-3-Clause
"""What is too deep, too large or no file at all is refused in one message, before it takes the stack, the memory or for
ever; what a run cannot use is said."""
import json
import os
import resource

from support import SCENE, changed, delam, expect, expect_error, finish, folder, read, start, write

MEMORY = 2 << 30


def small():
    """A small stack, and too little memory for what must not be read."""
    resource.setrlimit(resource.RLIMIT_STACK, (512 << 10, 512 << 10))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def with_file(name, text=None):
    path = os.path.join(folder(), name)
    if text is not None:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return path


def special(name):
    """Paths of that name, and the word for each: a pipe, a device without an end, a folder."""
    pipe, device, directory = (with_file(name) for _ in range(3))
    os.mkfifo(pipe)
    os.symlink("/dev/zero", device)
    os.mkdir(directory)
    return (pipe, "a pipe"), (device, "a device"), (directory, "a folder")


def sparse(name, size):
    path = with_file(name, "")
    os.truncate(path, size)
    return path


# Depth: in the file and in a setting. test_scene_text.cpp has more.
many = "a." * 59999 + "a"
expect_error(start("check", write(f"schema = 1\n[{many}]\n"), preexec_fn=small), 2,
             r"scene\.toml:2: 60000 levels .* at most 32")
expect_error(start("check", write(f"schema = 1\n{many} = 1\n"), preexec_fn=small), 2, r"scene\.toml:2: 60000 levels")
scene = write(SCENE)
for setting in ("a." * 299 + "a=1", "solver.x=" + "[" * 300 + "]" * 300, "solver={ " + "a." * 9999 + "a = 1 }",
                "a." * 19 + "a={ " + "b." * 19 + "b = 1 }"):
    expect_error(delam("check", scene, "--set", setting), 2, "^delam: --set", "levels", "at most 32")

# Files that are none, and those that are too large.
for path, kind in special("scene.toml"):
    expect_error(delam("check", path), 2, f"{path}: cannot be read: it is {kind}")
expect_error(delam("check", sparse("scene.toml", (16 << 20) + 1)), 2, "16777217 bytes.*at most 16777216")
expect_error(delam("check", write("schema = 1\n#" + "x" * ((16 << 20) - 12))), 2, "dimension|geometry")
MESH = 'schema = 1\n[mesh]\nfile = "{}"\n'
for name in ("m.inp", "m.msh"):
    for path, kind in special(name):
        expect_error(delam("check", write(MESH.format(path))), 2, r"scene\.toml:3: mesh\.file", f"it is {kind}")
expect_error(delam("check", write(MESH.format(sparse("m.inp", 5 << 30)))), 2, "5368709120 bytes.*at most 1073741824")
expect_error(start("check", write(MESH.format(sparse("m.msh", 5 << 30))), preexec_fn=small), 2, "MeshFormat")
mesh = with_file("m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
os.truncate(mesh, 5 << 30)
expect_error(start("check", write(MESH.format(mesh)), preexec_fn=small), 2, "5368709120 bytes.*at most 1073741824")

# Files that include others: by number, by size, and what they may be.
bomb = folder()
for level in range(8):
    with open(os.path.join(bomb, f"{level}.inp"), "w", encoding="utf-8") as file:
        file.write(f"*INCLUDE, INPUT={level + 1}.inp\n" * 200)
with open(os.path.join(bomb, "8.inp"), "w", encoding="utf-8") as file:
    file.write("** the end\n")
expect_error(delam("check", write(MESH.format(os.path.join(bomb, "0.inp")))), 2, r"7\.inp:\d+: \*INCLUDE",
             "is file 1001 of this mesh.*at most 1000")
part = with_file("m.inp", f"*INCLUDE, INPUT={sparse('large.inp', 1 << 30)}\n")
expect_error(delam("check", write(MESH.format(part))), 2, r"m\.inp:1: \*INCLUDE",
             "10737[0-9]+ bytes.*at most 1073741824")
for path, kind in special("part.inp"):
    expect_error(delam("check", write(MESH.format(with_file("m.inp", f"*INCLUDE, INPUT={path}\n")))), 2,
                 r"m\.inp:1: \*INCLUDE", f"it is {kind}")
# Sets that name each other, 100 times each; and numbers without an end.
CELL = "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE=CPE4, ELSET=S0\n1, 1, 2, 3, 4\n"
nested = CELL + "".join(f"*{kind}, {kind}=S{i + 1}\n" + f"S{i}, " * 99 + f"S{i}\n"
                        for i in range(20) for kind in ("ELSET", "NSET"))
nested += "*NSET, NSET=S0\n1, 2\n*SURFACE, NAME=F\nS20, S1\n"
expect_error(delam("check", write(MESH.format(with_file("m.inp", nested)))), 2, "materials|bodies")
for kind, word in (("ELSET", "element"), ("NSET", "node")):
    circle = with_file("m.inp", nested + f"*{kind}, {kind}=S0\nS20\n")
    expect_error(delam("check", write(MESH.format(circle))), 2,
                 rf"m\.inp:\d+: \*{kind}: {word} sets contain each other")
for line, missing in (("1, 999999999\n", 5), ("-1, 9223372036854775807\n", -1), ("4, 9223372036854775804, 100\n", 104),
                      ("-9223372036854775808, 9223372036854775807\n", -9223372036854775808)):
    numbers = write(MESH.format(with_file("m.inp", CELL + "*NSET, NSET=N, GENERATE\n" + line)))
    expect_error(start("check", numbers, preexec_fn=small), 2, rf"m\.inp:9: \*NSET: node {missing} is not there")
ends = with_file("m.inp", CELL + "*NSET, NSET=N, GENERATE\n9223372036854775803, 9223372036854775807, 2\n")
expect_error(delam("check", write(MESH.format(ends))), 2, r"m\.inp:9: \*NSET: node 9223372036854775803 is not there")

# Texts that no result can hold are refused by both commands, and so are patterns that fit nothing.
long = "x" * 2000000
for old, new, where in (('title = "small ENF"', f'title = "{long}"', "title"),
                        ('name = "lower"', f'name = "{long}"', r"layers\[0\]\.name"),
                        ("dimension = 2", f'dimension = 2\nplane = "{long}"', r"geometry\.plane")):
    path = write(changed(old, new))
    for words in (("check", path), *([("run", path, "--out", folder())] if where == "title" else [])):
        answer = delam(*words)
        expect_error(answer, 2, where, "has 2000000 bytes: at most 4096")
        expect(len(answer[2]) < 1000, f"{words[0]}: a short message, {len(answer[2])} bytes")
answer = delam("check", write(changed("young = 75e9", f'young = "{long}"')))
expect_error(answer, 2, r"materials\[0\]\.young", "a number")
expect(len(answer[2]) < 1000, f"a short message, {len(answer[2])} bytes")
body = MESH.format(with_file("m.inp", CELL)) + ('[[materials]]\nname = "m"\nyoung = 1\npoisson = 0.3\n[[bodies]]\n'
                                               'material = "m"\nname = "{}"\n')
expect_error(start("check", write(body.format("*" * 4096)), preexec_fn=small), 2, "time")
same = with_file("m.inp", CELL.replace("ELSET=S0", "ELSET=" + "S" * 40))
fitting = body.replace(body.split('"')[1], same)
expect_error(delam("check", write(fitting.format("*S" * 20 + "*T"))), 2, "no body of the mesh fits")
expect_error(delam("check", write(fitting.format("*S" * 20 + "*S"))), 2, "time")

# Names that read like those in the library's messages, which are made of numbers of bodies.
between = changed("point = [0.060, 0.006]", "point = [0.060, 0.003]")
for name in ("bodies 0" + ", 0" * 1300, "body " + "1" * 40):
    expect_error(start("check", write(between.replace('"lower"', f'"{name}"')), preexec_fn=small), 2,
                 r"loads\[0\]\.point", name[:20])
bulky = with_file("m.inp", CELL.replace("ELSET=S0", "ELSET=" + long))
expect_error(delam("check", write(body.replace(body.split('"')[1], bulky).format("*"))), 2, "the name of a body",
             "2000000 bytes.*at most 4096")

# --resume reads its state only if it may be one.
brief = write(changed("steps = 20", "steps = 2"))
out = folder()
running = os.path.join(out, "running")
os.mkdir(running)
state = os.path.join(running, "state.bin")
os.mkfifo(state)
expect_error(delam("run", brief, "--out", out, "--resume"), 3, "state.bin", "no regular file")
os.remove(state)
with open(os.path.join(running, ".delam"), "w", encoding="utf-8"):
    pass  # the marker of a run that was killed while it wrote it
for begin in ("", '{"kind":"delam state 3",\n', '{"kind":"delam state 4","' + "x" * 100000):
    with open(state, "w", encoding="utf-8") as file:
        file.write(begin)
    os.truncate(state, 5 << 30)
    answer = start("run", brief, "--out", out, "--resume", preexec_fn=small)
    expect_error(answer, 2, "state.bin", "damaged")
os.remove(state)
result = os.path.join(out, "result.json")
os.mkfifo(result)
expect_error(delam("run", brief, "--out", out, "--resume"), 3, "result.json", "no regular file")

# More threads than processors: fewer work, and both commands say so.
feti = '[solver]\nreduction = "feti"\nsubdomains = 4\nthreads = 256\n'
crowded = write(changed("steps = 20", "steps = 1", changed("h = 0.0015", "h = 0.003")) + feti)
count = len(os.sched_getaffinity(0))
said = f"option threads = 256: {count} are used, the number of processors of this process"
code, text, error = delam("check", crowded)
expect(code == 0 and f"warning: {said}" in error and f"{count} of the library (option threads = 256" in text,
       f"check bounds threads: {error.strip()}")
out = folder()
code, text, error = delam("run", crowded, "--out", out)
expect(code == 0 and f"warning: {said}" in text, f"so does run: {text} {error}")
expect(f"{count} of the library (option threads = 256" in json.loads(read(os.path.join(out, "result.json")))["plan"],
       "so does result.json")
plain = folder()
delam("run", crowded, "--out", plain, "--set", "solver.threads=1")
expect(read(os.path.join(plain, "history.csv")) == read(os.path.join(out, "history.csv")), "no digit depends on them")
finish()
