# SPDX-License-Identifier: BSD-3-Clause
"""The program replaces and removes what it has written itself, and says by name what else is in its way: in the folder
of a run, of a sweep, of a fit, and where a page or a scene is to be written. Nothing of anybody else changes."""
import json
import os
import shutil
import signal
import subprocess

from support import DELAM, changed, delam, expect, expect_error, finish, folder, read, start, write

SMALL = changed("steps = 20", "steps = 3", changed("h = 0.0015", "h = 0.003"))
scene = write(SMALL)


def listing(path):
    """Every file below a folder with what it holds, every folder, and where links lead."""
    out = {}
    for at, folders, files in os.walk(path):
        for name in folders + files:
            whole = os.path.join(at, name)
            out[os.path.relpath(whole, path)] = (os.readlink(whole) if os.path.islink(whole) else
                                                 None if os.path.isdir(whole) else read(whole))
    return out


def put(path, text="of somebody else\n"):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def refused(what, out, *words, says, code=3):
    """The command ends with a message that names the file, and the folder is as it was."""
    before = listing(out)
    answer = delam(*words)
    expect_error(answer, code, says)
    expect(listing(out) == before, f"{what}: nothing has changed")


# Folders of a run.
for name in ("running/notes.txt", "running/history.csv", "running/state.bin", "running/step_00000001.bin.bak",
             "running/old/notes.txt", "history.csv", "fields.h5", "state.bin", "jumps.csv", "fields.xdmf"):
    out = folder()
    put(os.path.join(out, name))
    place = name.replace("/old/notes.txt", "/old").replace(".", r"\.")
    refused(name, out, "run", scene, "--out", out, says=place)
    refused(name + ", resumed", out, "run", scene, "--out", out, "--resume", says=place)
for text in ("", "{}", '{"program": "another"}', '{"program": "delam"}', "no json"):
    out = folder()
    put(os.path.join(out, "result.json"), text)
    refused(f"a result.json that says {text!r}", out, "run", scene, "--out", out, says=r"result\.json")
out = folder()
put(os.path.join(out, "notes.txt"))
put(os.path.join(out, "2025", "thesis.txt"))
expect(delam("run", scene, "--out", out)[0] == 0, "files that are not in the way may be there")
expect(read(os.path.join(out, "notes.txt")) == read(os.path.join(out, "2025", "thesis.txt")), "and stay")
expect(delam("run", scene, "--out", out)[0] == 0, "a result of one's own is replaced")
expect(sorted(set(os.listdir(out)) - {"jumps.csv"}) == ["2025", "fields.h5", "fields.xdmf", "history.csv", "notes.txt",
                                                        "result.json", "state.bin"], "there is no other file")
# A file that has the name of a result's file, and does not belong to the one that is there.
about = json.loads(read(os.path.join(out, "result.json")))
about["files"].pop("jumps.csv", None)  # as of a result without jumps
put(os.path.join(out, "result.json"), json.dumps(about))
put(os.path.join(out, "jumps.csv"))
refused("jumps.csv beside a result without jumps", out, "run", scene, "--out", out, says=r"jumps\.csv, which does not")
os.remove(os.path.join(out, "jumps.csv"))
# A result that names no files is one of earlier versions, or somebody has removed them.
del about["files"]
put(os.path.join(out, "result.json"), json.dumps(about))
code, said, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and "were not compared" in said, f"a result without hashes says so: {said}")
os.truncate(os.path.join(out, "result.json"), 3 << 30)
expect_error(delam("run", scene, "--out", out, "--resume"), 2, r"result\.json: .*3221225472 bytes, and at most 67108864")

# Links and second names: a folder elsewhere, files elsewhere.
for name in ("running", "running/state.bin", "running/.delam", "history.csv", "fields.h5", "result.json"):
    out, elsewhere = folder(), folder()
    target = put(os.path.join(elsewhere, "history.csv"))
    os.makedirs(os.path.dirname(os.path.join(out, name)), exist_ok=True)
    os.symlink(elsewhere if name == "running" else target, os.path.join(out, name))
    refused(f"a link {name}", out, "run", scene, "--out", out, says=r"symbolic link|something else has this name")
    expect(listing(elsewhere) == {"history.csv": b"of somebody else\n"}, f"a link {name}: its target stays")
for name in ("running/history.csv", "running/state.bin.new", "fields.h5"):
    out = folder()
    expect(delam("run", scene, "--out", out)[0] == 0, "a result")
    target = put(os.path.join(out, "notes.txt"))
    path = os.path.join(out, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if os.path.exists(path):
        os.remove(path)
    os.link(target, path)
    refused(f"a second name {name}", out, "run", scene, "--out", out, says="another name|neither a marker")
out, real = folder(), folder()
os.symlink(real, os.path.join(out, "scratch"))
expect(delam("run", scene, "--out", os.path.join(out, "scratch"))[0] == 0 and "result.json" in os.listdir(real),
       "the folder itself may be a link: its owner has named it")
for name in ("dangling", "notes.txt"):
    target = os.path.join(folder(), name)
    if name == "notes.txt":
        put(target)
    out = folder()
    os.makedirs(os.path.join(out, "running"))
    for beside in ("probe.new", "state.bin.new", "history.csv.new"):
        os.symlink(target, os.path.join(out, "running", beside))
    refused(f"links to {name} beside files of a run", out, "run", scene, "--out", out, says="symbolic link")
    expect(os.path.exists(target) == (name == "notes.txt"), f"{name} is as it was")

# Standard streams that are closed: their numbers go to no file.
whole = folder()
expect(delam("run", scene, "--out", whole)[0] == 0, "with all streams")
for closed in ("<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-"):
    out = folder()
    done = subprocess.run(["bash", "-c", f'"$@" {closed}', "bash", DELAM, "run", scene, "--out", out], check=False,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    same = all(read(os.path.join(out, name)) == read(os.path.join(whole, name))
               for name in ("history.csv", "state.bin", "fields.h5", "fields.xdmf"))
    expect(done.returncode == 0 and same, f"{closed}: exit {done.returncode}, the same result")

# Sweeps.
VARY = ["--vary", "laws.0.normal_toughness=200,300"]


def sweep(out, *words, vary=None):
    return start("sweep", scene, *(vary or VARY), "--out", out, *words)


def swept(what, out, *words, says, vary=None):
    before = {**listing(out), "study.lock": b""}
    expect_error(sweep(out, *words, vary=vary), 3, says)
    expect(listing(out) == before, f"{what}: nothing has changed")


for name in ("0001/history.csv", "0001.log", "table.csv", "curves.png", "response.png"):
    out = folder()
    put(os.path.join(out, name))
    swept(name, out, says=name.split("/", maxsplit=1)[0].replace(".", r"\."))
    swept(name + ", --replace", out, "--replace", says=name.split("/", maxsplit=1)[0].replace(".", r"\."))
out = folder()
for name in ("2025/january.csv", "2026/notes/a.txt", "12345.log", "9999", "notes.txt"):
    put(os.path.join(out, name))
others = listing(out)
expect(sweep(out)[0] == 0, "a sweep beside files of somebody else")
expect(sweep(out, "--replace", vary=["--vary", "laws.0.normal_toughness=220"])[0] == 0, "--replace discards its runs")
after = listing(out)
expect(all(after.get(name) == bytes_ for name, bytes_ in others.items()), "and nothing else")
expect("0001" in after and "0002" not in after and "0002.log" not in after, "all of them")
os.rename(os.path.join(out, "0001.log"), os.path.join(out, "kept"))
put(os.path.join(out, "0001.log"))
swept("0001.log in the place of a run's", out, "--replace", says=r"0001\.log", vary=["--vary", "time.steps=2"])
os.rename(os.path.join(out, "kept"), os.path.join(out, "0001.log"))
put(os.path.join(out, "0001", "notes.txt"))
before = listing(out)
expect_error(sweep(out, "--replace", vary=["--vary", "laws.0.normal_toughness=240"]), 3, r"0001/notes\.txt")
expect({**listing(out), "study.lock": b""} == {**before, "study.lock": b""}, "a file in a run: nothing is discarded")
for name in ("0001.log", "0002.log", "table.csv", "sweep.json"):
    out, elsewhere = folder(), folder()
    target = put(os.path.join(elsewhere, "notes.txt"))
    os.symlink(target, os.path.join(out, name))
    answer = sweep(out)
    expect(answer[0] in (2, 3) and name in answer[2] and read(target) == b"of somebody else\n",
           f"a link {name}: exit {answer[0]}, {answer[2].strip()}")
out = folder()
put(os.path.join(out, "sweep.json"), '{"scene": "of another program"}')
expect_error(sweep(out, "--replace"), 2, r"sweep\.json is of no sweep")
out, target = folder(), put(os.path.join(folder(), "notes.txt"))
os.symlink(target, os.path.join(out, "table.csv.new"))
expect(sweep(out)[0] == 0 and read(target) == b"of somebody else\n", "a link beside the table is not followed")

# Fits.
data = put(os.path.join(folder(), "curve.csv"), "x,y\n0.001,1\n0.002,2\n0.003,3\n")
FIT = ["fit", scene, "--data", data, "--parameters", "laws.0.normal_toughness=100:400"]
for name in ("fit.json", "fit.csv", "fit.png", "work/notes.txt"):
    out = folder()
    put(os.path.join(out, name))
    before = listing(out)
    expect_error(start(*FIT, "--out", out), 3, name.split("/", maxsplit=1)[0].replace(".", r"\."))
    expect(listing(out) == {**before, "study.lock": b""}, f"{name}: nothing has changed")

# Pages and scenes.
page = put(os.path.join(folder(), "page.html"))
expect_error(delam("view", whole, "--out", page), 2, r"page\.html is there already")
expect_error(delam("view", whole, "--out", page, "--replace"), 2,
             r"page\.html: this is not replaced.*a page of delam view")
expect(read(page) == b"of somebody else\n", "the page of somebody else stays")
os.remove(page)
expect(delam("view", whole, "--out", page)[0] == 0 and delam("view", whole, "--out", page, "--replace")[0] == 0,
       "one's own page is replaced")
put(os.path.join(whole, "view.html"))
expect_error(delam("view", whole), 2, r"view\.html: this is not replaced")
link = os.path.join(folder(), "page.html")
os.symlink(page, link)
expect_error(delam("view", whole, "--out", link, "--replace"), 2, "symbolic link")
put(page + ".new")
expect(delam("view", whole, "--out", page, "--replace")[0] == 0 and read(page + ".new") == b"of somebody else\n",
       "a file PAGE.new of somebody else stays")

# What a resume reads: every byte of the first line, the seal, and the files beside the state.
out = folder()
MANY = ["run", scene, "--set", "time.steps=200", "--set", "output.every=1", "--out"]
with subprocess.Popen([DELAM, *MANY, out], stdout=subprocess.PIPE, text=True) as process:
    for line in process.stdout:
        if line.startswith("step 5/"):
            process.send_signal(signal.SIGINT)
words = ["run", "--resume", *MANY[1:]]
running = os.path.join(out, "running")
state = read(os.path.join(running, "state.bin"))
head = json.loads(state.split(b"\n")[0])
last = head["step"]
# What is true of this folder must come first: undamaged, it is resumed.
copy = os.path.join(folder(), "copy")
shutil.copytree(out, copy)
expect(delam(*words, copy)[0] == 0, "undamaged: resumed")
end = read(os.path.join(copy, "history.csv"))


def damaged(what, damage, says=r"run again without --resume"):
    one = os.path.join(folder(), "copy")
    shutil.copytree(out, one)
    damage(os.path.join(one, "running"))
    answer = delam(*words, one)
    expect_error(answer, 2, says)
    expect(delam(*MANY, one)[0] == 0 and read(os.path.join(one, "history.csv")) == end, f"{what}: then anew")


def changing(name, old, new):
    def damage(folder_):
        path = os.path.join(folder_, name)
        bytes_ = read(path)
        assert old in bytes_, (name, old)
        with open(path, "wb") as file:
            file.write(bytes_.replace(old, new, 1))
    return damage


for old, new in ((f'"step":{last}', f'"step":{last + 1}'), (f'"step":{last}', '"step":-1'),
                 ('"not_converged":[]', '"not_converged":[-1,1000000000000]'),
                 ('"not_converged":[]', '"not_converged":[1]'), (head["fields"][1], head["fields"][2])):
    damaged(f"{old} as {new}", changing("state.bin", old.encode(), new.encode()), r"state\.bin: damaged")
for at in [*range(0, len(state), max(1, len(state) // 40)), len(state) - 2]:
    one = os.path.join(folder(), "copy")
    shutil.copytree(out, one)
    with open(os.path.join(one, "running", "state.bin"), "r+b") as file:
        file.seek(at)
        file.write(bytes([state[at] ^ 1]))
    answer = delam(*words, one)
    # A byte of the head's name makes it another file, which then is no proof; else the seal shows it.
    expect(answer[0] in (2, 3), f"byte {at} of state.bin changed: exit {answer[0]}, {answer[2].strip()[-90:]}")
row = read(os.path.join(running, "history.csv")).split(b"\n")[2]
digit = next(at for at in range(len(row) // 2, len(row)) if row[at:at + 1].isdigit())
other = row[:digit] + (b"1" if row[digit:digit + 1] != b"1" else b"2") + row[digit + 1:]
damaged("a digit of the history", changing("history.csv", row, other), r"history\.csv: not as it was")
damaged("a missing history", lambda at: os.remove(os.path.join(at, "history.csv")), r"history\.csv")
step = "step_00000002.bin"
damaged("a missing step", lambda at: os.remove(os.path.join(at, step)), step + ": missing")
damaged("another step in its place",
        lambda at: shutil.copy(os.path.join(at, "step_00000003.bin"), os.path.join(at, step)), step + ": not as it was")
length = os.path.getsize(os.path.join(running, step))
for at in (length // 2, length - 100):
    def flip(folder_, at=at):
        with open(os.path.join(folder_, step), "r+b") as file:
            file.seek(at)
            byte = file.read(1)
            file.seek(at)
            file.write(bytes([byte[0] ^ 1]))
    damaged(f"byte {at} of a step", flip, step + ": not as it was")

# A result that is said to be complete is as it was written.
out = folder()
expect(delam("run", scene, "--out", out)[0] == 0, "a result")
for name in ("history.csv", "fields.h5", "fields.xdmf", "state.bin"):
    one = os.path.join(folder(), "copy")
    shutil.copytree(out, one)
    with open(os.path.join(one, name), "r+b") as file:
        file.seek(40)
        byte = file.read(1)
        file.seek(40)
        file.write(bytes([byte[0] ^ 1]))
    expect_error(delam("run", scene, "--out", one, "--resume"), 2, name + ": missing, or not as the run has written it")

# Texts that would command a terminal.
title = 'bad\\u001b[2J\\u001b]0;x\\u0007\\u009b31m \\u202e end'
evil = write(changed('title = "small ENF"', f'title = "{title}"', SMALL))
code, said, error = delam("run", evil, "--out", folder())
expect(code == 0 and not set(said + error) & {"\x1b", "\x07", "\x9b", "‮"} and r"\x1b[2J" in said,
       "a title is printed with its control characters escaped")
code, said, error = start("run", "no\x1b[31m\udcffsuch.toml", "--out", folder())
expect(code == 2 and "\x1b" not in error and r"no\x1b[31m\xffsuch.toml" in error, f"a name: {error.strip()}")
finish()
