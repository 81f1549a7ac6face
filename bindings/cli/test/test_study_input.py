# SPDX-License-Identifier: BSD-3-Clause
"""What sweep, fit and the plot scripts are given: files that are none or too large, numbers out of range, texts that
would move the cursor, interrupts at any time. Each ends with one printable line and the exit code of its kind.
`test_study_input.py whole` tries each text in all of its places, and more instants of an interrupt."""
import itertools
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

from support import DELAM, SCENE, changed, draw, expect, finish, folder, start, write

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "study"))
import command  # noqa: E402
from _pictures import input_file  # noqa: E402

MEMORY = 3 << 30
UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]")
SCENE_FILE = write(changed("steps = 20", "steps = 2"))
FIT = ["fit", SCENE_FILE, "--parameters", "laws.0.normal_toughness"]
SWEEP = ["sweep", SCENE_FILE]
GOOD = "x,y\n0,0\n0.002,10\n0.004,20\n"
WHOLE = sys.argv[1:] == ["whole"]


def small():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_STACK, (1 << 20, 1 << 20))


def file_of(text, name="curve.csv"):
    path = os.path.join(folder(), name)
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
    return path


def pairs(one, other):
    """Each of one with each of the other; in the quick tests each of both once at least."""
    if WHOLE:
        return list(itertools.product(one, other))
    return list(itertools.islice(zip(itertools.cycle(one), itertools.cycle(other)), max(len(one), len(other))))


def special(name):
    """Paths of that name that are no regular files, and the word for each."""
    pipe, device, directory, link = (os.path.join(folder(), name) for _ in range(4))
    os.mkfifo(pipe)
    os.symlink("/dev/zero", device)
    os.mkdir(directory)
    os.symlink(pipe, link)
    return (pipe, "a pipe"), (device, "a device"), (directory, "a folder"), (link, "a pipe")


def sparse(name, size):
    path = file_of("", name)
    os.truncate(path, size)
    return path


def expect_line(answer, code, who, *patterns):
    """One line of at most 1100 characters with nothing that moves a cursor."""
    status, shown, error = answer
    ok = (status == code and error.startswith(who + ": ") and error.count("\n") == 1 and len(error) < 1100
          and not UNPRINTABLE.search(error + shown) and all(re.search(p, error) for p in patterns))
    expect(ok, f"exit {code}, one line of {who}, {patterns}: got exit {status}: {error[-400:]!r}")


def fit(*words, data=None, **options):
    path = data if data is not None else file_of(GOOD)
    return start(*FIT, "--data", path, "--out", os.path.join(folder(), "out"), *words, preexec_fn=small, **options)


def sweep(*words):
    return start(*SWEEP, "--out", os.path.join(folder(), "out"), *words, preexec_fn=small)


def files():
    for path, kind in special("curve.csv"):
        expect_line(fit(data=path), 2, "delam: fit", f"cannot be read: it is {kind}")
    expect_line(fit(data=sparse("curve.csv", 5 << 30)), 2, "delam: fit", "5368709120 bytes, and at most 67108864")
    expect_line(fit(data="/nowhere/curve.csv"), 2, "delam: fit", "/nowhere/curve.csv: cannot be read: No such file")
    for path, kind in special("scene.toml"):
        words = ["--data", file_of(GOOD), "--parameters", "laws.0.normal_toughness", "--out", folder()]
        expect_line(start("fit", path, *words), 2, "delam: fit", f"cannot be read: it is {kind}")
        expect_line(start("sweep", path, "--vary", "laws.0.normal_toughness=1:2:2", "--out", folder()), 2, "delam: sweep",
                    f"cannot be read: it is {kind}")
    words = ["--vary", "laws.0.normal_toughness=1:2:2", "--out", folder()]
    expect_line(start("sweep", sparse("scene.toml", 5 << 30), *words, preexec_fn=small), 2, "delam: sweep",
                "5368709120 bytes, and at most 16777216")
    # What a study and the plot scripts read back.
    for path, _ in special("sweep.json"):
        out = folder()
        os.symlink(path, os.path.join(out, "sweep.json"))
        expect_line(start(*SWEEP, "--vary", "laws.0.normal_toughness=250:260:2", "--out", out), 2, "delam: sweep",
                    "sweep.json is of no sweep")


def results():
    """history.csv, result.json, jumps.csv and fields.h5 as they lie in a folder."""
    whole = os.path.join(folder(), "whole")
    code, _, error = start("run", SCENE_FILE, "--out", whole)
    expect(code == 0, f"a result: {error}")
    plots = [("plot", lambda out: [out]), ("plot_family", lambda out: ["--out", folder(), out])]
    for name in ("history.csv", "result.json", "fields.h5"):
        broken = [(kind, path) for path, kind in special(name)]
        broken.append(("bytes, and at most|damaged", sparse(name, 5 << 30)))
        broken += [("", file_of(text, name)) for text in (b"", b"\xff\xfe\x00", b"[" * 200000, b"1" * 200000, b"step,time\n1\n")]
        for pattern, path in broken:
            for script, words in plots:
                if name == "fields.h5" and script == "plot_family":
                    continue
                out = os.path.join(folder(), "result")
                shutil.copytree(whole, out)
                os.remove(os.path.join(out, name))
                os.symlink(path, os.path.join(out, name))
                code, error = draw(script, *words(out))
                expect_line((code, "", error), 2, "delam", name, pattern)
    # As people call it.
    done = subprocess.run([sys.executable, os.path.join(HERE, "..", "plot", "plot.py"), whole, "--cut", "y=nan"],
                          capture_output=True, text=True, timeout=60, check=False)
    expect_line((done.returncode, done.stdout, done.stderr), 2, "plot.py", "--cut y=nan")
    # The same folders by the package's reader, which has no lines but exceptions.
    for path, _ in special("result.json"):
        try:
            input_file.read_json(path, 10)
            expect(False, f"{path} is read")
        except input_file.Unreadable:
            expect(True, "a reader of the package refuses what is not regular")


def counts():
    for values in ("1:2:1000000000", "1:2:1000001", "1e-3:2e3:99999999999999999999:log", "1,2," + "3," * 1000000 + "4"):
        if len(values) < 100000:  # the system allows no longer words
            expect_line(sweep("--vary", f"laws.0.normal_toughness={values}"), 2, "delam: sweep",
                        "values: at most 1000000 are allowed")
    many = [word for k in range(4) for word in ("--vary", f"laws.0.key{k}=1:2:1000")]
    expect_line(sweep(*many), 2, "delam: sweep", "--vary: 4e.12 values: at most 1000000")
    expect_line(sweep("--vary", "laws.0.a=1:2", "--vary", "laws.0.b=1:2", "--latin", "1000000"), 2, "delam: sweep",
                "--latin 1000000: 2000000 values: at most 1000000")


def numbers():
    huge = "9" * 5000
    for scale in ("nan", "inf", "-inf", "0", "1e-400", "1e400", "1e308"):
        code, shown, error = fit("--scale", scale)
        expect(code == 2 and "Traceback" not in error and "--scale" in error and "is expected" in error,
               f"--scale {scale}: {error!r}")
    for confidence in ("nan", "inf", "0", "1", "-1", "1e400", "x"):
        code, shown, error = fit("--confidence", confidence)
        expect(code == 2 and "Traceback" not in error and "--confidence" in error, f"--confidence {confidence}: {error!r}")
    for y, place in pairs(("1e308", "1e-320", "inf", "1e400", huge, "-1e308", "1e151"), ("10", "0.002")):
        words = "curve.csv: row 2 of the numbers" if place == "10" else "curve.csv"
        expect_line(fit(data=file_of(GOOD.replace(place, y))), 2, "delam: fit", words)
    expect_line(fit("--scale", "1e149", data=file_of(GOOD)), 2, "delam: fit", "times --scale 1e.149 is 1e.150|is expected")
    for text, where in pairs(("x" * 200000, "y\n" * 3, '"' + "1" * 200000 + '"', "1\x002", "1\n2\x1b[31m", ";;;;", '"', "x,y\n1,2\n\x9b3,4"),
                             ("{}\n1,2\n2,3\n", "x,y\n1,{}\n2,3\n", "x,y\n1,2\n{},3\n")):
        expect_line(fit(data=file_of(where.format(text))), 2, "delam: fit", "curve.csv")
    for text, form in pairs(("nan", "inf", "1e400", "1e-320", huge, "x", "\x1b[31m"), ("=1:{}", "={}:1000", "@{}", "=0:1000@{}")):
        answer = start("fit", SCENE_FILE, "--data", file_of(GOOD), "--out", folder(), "--parameters",
                       "laws.0.normal_toughness" + form.format(text))
        expect_line(answer, 2, "delam: fit", "--parameters laws\\[0\\].normal_toughness|starts at")
    for values in ("nan:1:3", "1:inf:3", "1:1e400:3", f"1:{huge}:3", f"1:2:{huge}", f"{huge},1", "1e400,2", "1e-320,2",
                   "9223372036854775808,1", "[" * 5000 + ",1", "nan,1", "inf,1", "1:2:x", "1:2:3:4", "\x1b[31m:2:3", "1,\x1b]0;a\x07"):
        expect_line(sweep("--vary", f"laws.0.normal_toughness={values}"), 2, "delam: sweep", "normal_toughness|no run is a scene")
    for key in ("laws." + "9" * 5000 + ".x", "a" * 100000, "a\x1b[2Jb", "a\u202eb", "laws.0.\udcff"):
        expect(fit("--parameters", key)[0] == 2, f"key {key[:20]!r}")
        answer = sweep("--vary", f"{key}=1:2:2")
        expect(answer[0] == 2 and "Traceback" not in answer[2] and not UNPRINTABLE.search(answer[2]), f"a key: {answer[2][:200]!r}")
    # Of a scene: numbers of 400 digits, and tables within each other.
    for text in ("9" * 400, "1e-320", huge):
        wrong = write(changed("normal_toughness = 250.0", f"normal_toughness = {text}"))
        answer = start("fit", wrong, "--data", file_of(GOOD), "--out", folder(), "--parameters", "laws.0.normal_toughness")
        expect_line(answer, 2, "delam: fit")
    deep = write(SCENE + "[x]\ny = " + "[" * 50000 + "]" * 50000 + "\n")
    answer = start("fit", deep, "--data", file_of(GOOD), "--out", folder(), "--parameters", "laws.0.normal_toughness")
    expect_line(answer, 2, "delam: fit", "scene.toml")


def texts():
    """One filter, which shows the bytes that it does not pass."""
    for text, shown in (("a\x1b[31mb", r"a\x1b[31mb"), ("\x9b", r"\xc2\x9b"), ("\u202e", r"\xe2\x80\xae"), ("\udcff", r"\xff"),
                        ("\u2028", r"\xe2\x80\xa8"), ("\u2066x\u2069", r"\xe2\x81\xa6x\xe2\x81\xa9"), ("\x7f\r\0", r"\x7f\x0d\x00"),
                        ("µ\n\té\\x1b", "µ\n\té\\x1b")):
        expect(command.printable(text) == shown, f"{text!r} is shown as {shown!r}: {command.printable(text)!r}")
    title = write(changed('name = "ductile"', 'name = "duc\\u001b[31mtile"',
                          changed('law = "ductile"', 'law = "duc\\u001b[31mtile"')).replace("steps = 20", "steps = 2"))
    for words in (("sweep", title, "--vary", "laws.0.normal_toughness=50:60:2"),
                  ("fit", title, "--data", file_of(GOOD), "--parameters", "laws.0.normal_toughness=0:40@30")):
        code, shown, error = start(*words, "--out", os.path.join(folder(), "o\x1b[1mut"))
        expect(code != 0 and not UNPRINTABLE.search(shown + error), f"{words[0]}: names of a scene: {shown!r} {error!r}")
    # Nothing prints but through the filter.
    for place in ("study", "plot"):
        for name in sorted(os.listdir(os.path.join(HERE, "..", place))):
            if name.endswith(".py") and name != "command.py":
                with open(os.path.join(HERE, "..", place, name), encoding="utf-8") as file:
                    text = file.read()
                expect(not re.search(r"\bprint\(|\.write\(.*std|sys\.std", text), f"{place}/{name} prints through command.py")
    # A pipe that nobody reads.
    with subprocess.Popen([DELAM, *SWEEP, "--vary", "laws.0.normal_toughness=250:260:2", "--out", os.path.join(folder(), "out")],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        child.stdout.close()
        error = child.stderr.read()
    expect_line((child.returncode, "", error), 3, "delam: sweep", "Broken pipe")


def interrupts():
    """At any time: while the interpreter starts, while modules load, while analyses run."""
    scene = write(changed("h = 0.0015", "h = 0.0005", changed("steps = 20", "steps = 2000")))
    curve = file_of(GOOD)  # times the scale, it rises like the scene
    seen, wrong = set(), []
    for which, words in enumerate((["fit", scene, "--data", curve, "--scale", "2376", "--parameters", "laws.0.normal_toughness"],
                                   ["sweep", scene, "--vary", "laws.0.normal_toughness=250:260:2"])):
        for k in range(24) if WHOLE else range(which, 24, 5):
            sent = (signal.SIGINT, signal.SIGTERM)[k % 2]
            with subprocess.Popen([DELAM, *words, "--out", os.path.join(folder(), "out")], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, start_new_session=True) as child:
                time.sleep(0.002 * 1.33 ** k)
                os.killpg(child.pid, sent) if k % 3 else child.send_signal(sent)
                _, error = child.communicate(timeout=120)
            seen.add(child.returncode)
            # Before the program is loaded, the signal ends it without a word.
            mute = child.returncode == -sent and not error
            # On a fast machine the fit ends before the last signals: these data tell nothing of the toughness. A signal may
            # meet the interpreter as it ends, when it no longer has handlers.
            ended = which == 0 and child.returncode in (4, -sent) and "the data tell none" in error
            if not mute and not ended and not (child.returncode == 130 and error.count("\n") == 1 and "interrupted" in error):
                wrong.append((which, k, child.returncode, error[-300:]))
    expect(not wrong and 130 in seen, f"each interrupt is one line: {wrong}")


files()
results()
counts()
numbers()
texts()
interrupts()
finish()
