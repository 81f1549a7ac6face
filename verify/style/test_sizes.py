# SPDX-License-Identifier: BSD-3-Clause
"""Tests the scanners of functions and of classes on code whose numbers are known, and plants what sizes.py, words.py,
readmes.py, arrows.py, sentences.py, english.py and names.py must refuse."""

import pathlib
import sys
import tempfile

import arrows
import classes
import english
import names
import readmes
import scanner
import sentences
import sizes
import words

CODE = r'''#include <vector>
#define SHORT(x) \
    { x }
namespace delam {
namespace {
constexpr int table[] = {1, 2}, other[] = {3};  // a comment with {
constexpr Row rows[] = {
    {"a", 1},
    {"b{", 2},
};
const char* text() { return "}"; }
}  // namespace
extern "C" {
int one(void) { return 1; }
int two(void) {
    return '{' + 1'000;
}
}
Thing::Thing(int a)
    : a_{a},
      b_(make([](int i) { return i; })),
      c_{std::vector<int>{1, 2}} {
    if (a) {
        b_ = 0;
    }
}
template <class T, class U = Pair<int, int>>
struct Holder {
    struct Inner {
        int x{0};
    };
    explicit Holder(T t) : t_(t) {}
public:
    int get() const noexcept {
        return t_;
    }
    std::function<int(int)> call = [](int i) {
        return i;
    };
    T t_;
};
int long_signature(int a,
                   int b) {
    return a + b;
}
}  // namespace delam
'''
# First line and number of lines, counted by hand.
EXPECTED = [(11, 1), (14, 1), (15, 3), (19, 8), (32, 1), (34, 3), (37, 3), (42, 4)]


def lengthy(lines):
    return "int f() {\n" + "    g();\n" * (lines - 2) + "}\n"


HOUSE = {"scene/scene.cpp": ["scene/scene.hpp", "mesh/mesh.hpp"], "scene/scene.hpp": [],
         "mesh/mesh.hpp": ["mesh/cells/cell.hpp"], "mesh/cells/cell.hpp": []}
TABLES = ["| `scene/` | input | mesh |\n| `mesh/` | geometry | - |\n",
          "| `mesh/.` | the mesh | mesh/cells |\n| `mesh/cells/` | cells | - |\n"]


PACKAGE = {"__init__.py": "from .solver import Solver\n", "solver.py": "from ._base import raw\nfrom .history import History\n",
           "history.py": "from ._base.needs import Solver\n", "_base/__init__.py": '"""Rooms."""\n', "_base/raw.py": "import ctypes\n",
           "_base/needs.py": "from . import raw\n"}
ROOMS = ["| `_base/` | the library | - |\n"]


def planted_imports():
    """Plants imports that a package must not have, in each of Python's forms, and texts that are none; returns how many."""
    def found(name, text):
        return arrows.problems("delam", ROOMS, arrows.needs(PACKAGE | {name: PACKAGE.get(name, "") + text}, "delam"))

    circle = ["from .solver import Solver", "from . import solver", "from delam.solver import Solver", "from delam import solver",
              "import delam.solver", "def plot():\n    from .solver import Solver", "if TYPE_CHECKING:\n    from .solver import Solver",
              'KINDS = {"bodies": (".solver", "draw")}', 'importlib.import_module("delam.solver")']
    for text in circle:
        assert found("history.py", text) == ["delam: a circle of files: history, solver"], f"{text}: {found('history.py', text)}"
    whole = found("history.py", "from . import Solver")
    assert whole == ["delam: a circle of files: __init__, history, solver"], whole
    for text in ("from .. import history", "from ..history import History", "import delam.history", "import delam"):
        assert any("in no table" in line for line in found("_base/raw.py", text)), text
    many = dict.fromkeys((f"m{i}.py" for i in range(arrows.CONCEPTS)), "")
    assert any("concepts" in line for line in arrows.problems("delam", ROOMS, arrows.needs(PACKAGE | many, "delam")))
    for text in ('"""See delam.solver, which is above."""', 'f"{time:.3g}"', 'open("solver.py")', "import solver", "from . import raw"):
        assert found("_base/needs.py", text) == [], f"{text} was refused"
    return len(circle) + 6


def planted_arrows():
    """Plants a fault of each kind in a house without any; returns how many."""
    assert arrows.problems("src", TABLES, HOUSE) == []
    many = {f"mesh/cells/c{i}.hpp": [] for i in range(arrows.CONCEPTS)}
    faults = {
        "in no table": (TABLES, HOUSE | {"mesh/cells/cell.hpp": ["scene/scene.hpp"]}),
        "but no file needs it": ([TABLES[0].replace("- |", "cells |"), "| `cells/` | cells | - |\n", TABLES[1]], HOUSE),
        "points up": (["".join(reversed(TABLES[0].splitlines(True))), TABLES[1]], HOUSE),
        "there is no such room": ([TABLES[0].replace("- |", "law |"), TABLES[1]], HOUSE),
        "circle of files: mesh/mesh, scene/scene": (TABLES, HOUSE | {"mesh/mesh.hpp": ["mesh/cells/cell.hpp", "scene/scene.hpp"]}),
        f"{arrows.CONCEPTS + 1} concepts": (TABLES, HOUSE | many),
        f"{arrows.FOLDERS + 1} folders": (TABLES, HOUSE | {f"mesh/f{i}/x.hpp": [] for i in range(arrows.FOLDERS)}),
    }
    for words_of_it, (tables, house) in faults.items():
        found = arrows.problems("src", tables, house)
        assert any(words_of_it in line for line in found), f"{words_of_it}: {found}"
    assert list(arrows.twice({"src": ["a/x.hpp"], "other": ["a/x.hpp", "a/y.hpp"]}))
    assert not list(arrows.twice({"src": ["a/x.hpp"], "other": ["a/x.cpp", "b/x.hpp"]}))
    return len(faults) + 1


def header(comment, behind="stop"):
    return (f"/* {comment}\n * [status -; since 0.1] */\nDELAM_API int32_t delam_f(void);\n"
            f"#define DELAM_STOP 1 /* {behind} */\n")


def planted_sentences():
    """Plants a fault of each kind in the comment of a function; returns how many."""
    full = "Returns " + "one " * (sentences.LONGEST - 1)
    short = " It stops." * sentences.LONGEST
    table = f"\n *   row  {'one ' * (sentences.LONGEST - 3)}\n *        and.\n *   row  two"
    fine = (full.strip() + "." + short, "Returns rows:" + table, "Selects as delam_solver_look does.")
    for comment in fine:
        assert not list(sentences.problems("a.h", header(comment))), f"{comment} was refused"
    faults = {
        f"{sentences.LONGEST + 1} words": full + "more." + short,
        "words, at most": full.replace("one one one", "one, e.g. one") + "more." + short,
        "row": "Returns rows:" + table.replace("and.", "and more, " + "one " * 3),
        "on average": (full.strip() + ". ") * 2,
        "does not begin with a verb": "The number of steps.",
        "does not begin with a verb such": "One of the ranks alone: returns it.",
        "'marches' is a word of the house": "Returns how many marches there are.",
        "'Aside' is a word of the house": "Returns it. Aside from that, nothing.",
    }
    for words_of_it, comment in faults.items():
        found = list(sentences.problems("a.h", header(comment)))
        assert len(found) == 1 and words_of_it in found[0], f"{words_of_it}: {found}"
    found = list(sentences.problems("a.h", header("Returns it.", "one " * (sentences.LONGEST + 1))))
    assert len(found) == 1, f"a comment behind a constant: {found}"
    return len(faults) + 1


def planted_english():
    """Plants fragments and private words; returns how many."""
    fragment, private = "a comment needs a subject and a verb", "is a private word"
    refused = {
        "// What a search has found.\nint a;\n": fragment,
        "// SPDX-License-Identifier: BSD-3-Clause\n// Whether the pair\n// adheres.\n": fragment,
        "// Of the last step.\nint a;\n": fragment,
        "int a;  // what is left\n": fragment,
        "// Those of the part.\nint a;\n": fragment,
        "// For messages.\nint a;\n": fragment,
        "// In units of the mesh; 0: none.\nint a;\n": fragment,
        "// Where the nodes of a cell sit.\nint a;\n": fragment,
        "// A march through all steps.\nint a;\n": private,
        "int looked_at_ = 0;\n": private,
        "double debt_ = 0.0;\n": private,
        'fail("the energies that a step books");\n': private,
        "struct Beneath {};\n": private,
    }
    for text, what in refused.items():
        assert any(what in line for line in english.problems("src/a/b.cpp", text)), f"{text!r} was not refused"
    fine = [
        "// Returns what a search has found.\nint a;\n",
        "double mass;  // of each body\n",
        "// In the plane the rotation about z is the first component.\nint a;\n",
        "// Where the load is zero, nothing moves.\nint a;\n",
        "// It refuses what nobody needs.\nint a;\n",
        'call(delam_solver_look(solver, -1), "estimate_hollow");\n',
        "// An up-looking factorisation refreshes the Marchenko overlook.\nint a;\n",
    ]
    for text in fine:
        assert not list(english.problems("src/a/b.cpp", text)), f"{text!r} was refused"
    for text in ("marches = []\n", "fresh = []\n", "# What is booked.\n", "solver.look(1)\n", "# Put it aside.\n"):
        assert list(english.problems("verify/a.py", text)), f"{text!r} was not refused"
    assert not list(english.problems("verify/a.py", "solver.march(t)\n"))
    assert list(english.problems("src/a/README.md", "A fresh factor.\n")) and not list(english.problems("src/a/README.md", "Whether.\n"))
    package, docstring = "bindings/python/src/delam/a.py", 'def a():\n    """%s"""\n'
    for text in (docstring % "Whether it is closed.", docstring % "Of the last step.", "# What others call it.\nA = 1\n"):
        assert list(english.problems(package, text)), f"{text!r} was not refused"
    for text in (docstring % "True if it is closed.", "# SPDX-License-Identifier: BSD-3-Clause\n# Names of others.\nA = 1  # of them\n"):
        assert not list(english.problems(package, text)), f"{text!r} was refused"
    return len(refused) + 4


def planted_steps():
    """Plants faults in the lines that follow one load step; returns how many."""
    source = "void Stepper::step(int a,\n                   int b) {\n    search(a);\n}\ninline int free() { return call(1); }\n"
    with tempfile.TemporaryDirectory() as folder:
        src = pathlib.Path(folder) / "src"
        src.mkdir()
        (src / "a.cpp").write_text(source, encoding="utf-8")

        def found(function, path="a.cpp", lines=readmes.STEPS):
            text = "".join(f"{n}. `{path}`: `{function}` minimises.\n" for n in range(1, lines + 1))
            (src / "README.md").write_text(text, encoding="utf-8")
            return list(readmes.misled(src))

        assert found("Stepper::step") == found("free") == []
        refused = [found(name) for name in ("search", "call", "step", "Search::step", "Stepper::ste")]
        refused += [found("free", "b.cpp"), found("free", lines=readmes.STEPS - 1)]
        assert all(refused), refused
    return len(refused)


# Methods of Wide and of Base, none of Wide::Inner and of Narrow, counted by hand.
WIDE = r'''// a comment with class Other { public: int no(); };
namespace delam::inner {
enum class Kind : int { one, two };
template <class T, int n = (3 > 2)>
class API alignas(8) Wide final : public Base<T, int> {
    int hidden() const;
public:
    Wide() = default;
    explicit Wide(T t) : t_{t}, f_(make([](int i) { return i; })) { use(t); }
    Wide(const Wide&) = delete;
    ~Wide() override;
    void none() = delete;
    int first() const { return a < b ? 1 : 2; }
    [[nodiscard]] std::map<int, std::vector<T>> second(int (*f)(int), T t = T{}) const;
    template <class U>
        requires requires(U u) { u.size(); }
    void third(const U& u) { call(u, [] { return "}"; }); }
    template <class U> requires(Big<U> && true) static auto fourth() noexcept(true) -> std::vector<U>;
    T operator()(int i) const;
    explicit operator bool() const { return true; }
    bool operator<(const Wide& other) const noexcept;
    bool operator==(const Wide&) const = default;
    decltype(auto) ninth() &&;
    int (*tenth(int i))(double);
    void eleventh();
    void (*pointer)(int);
    int (Wide::*member)(int) const;
    int overridden() const override { return 1; }
    virtual void last(int) final;
    friend bool operator>(const Wide& a, const Wide& b) { return b < a; }
    friend class Other;
    int twelfth();
    using Base<T>::hidden;
    using Call = std::function<int(int)>;
    typedef int Array[4];
    static_assert(sizeof(T) > 1, "text");
    struct Inner {
        int x{0}, y = call(1);
        Inner(int) {}
    };
    enum { some = call(2) };
    std::function<int(int)> value = [](int i) { return i; };
    int (*plain)(int) = nullptr;
    alignas(16) std::array<double, (4 > 3)> data{{1.0, 2.0}};
    unsigned bits : 3;
protected:
    void less();
private:
    void hidden_too() {}
public:
    int thirteenth();
};
struct Base {
    virtual int value() const = 0;
    virtual ~Base() = default;
private:
    int own();
};
class Narrow { int own(); };
class Declared;
}
'''
METHODS = {"delam::inner::Wide": 13, "delam::inner::Wide::Inner": 0, "delam::inner::Base": 1, "delam::inner::Narrow": 0}


def planted_classes():
    """Counts methods that are known, and plants classes that have too many or whose members are scattered; returns how many."""
    found = {c.key: c for c in classes.find({"src/a/wide.hpp": WIDE})}
    counted = {key: len(c.methods) for key, c in found.items()}
    assert counted == METHODS, f"{counted}: {found['delam::inner::Wide'].methods}"
    lines = [c.line for c in found.values()]
    assert lines == [4, 37, 53, 59], lines

    def refused(texts):
        return list(sizes.wide_classes(sizes.classes_of(texts)))

    def full(methods, more=""):
        return f"class A : public B {{\npublic:\n{more}" + "    int f() const { return 1; }\n" * methods + "};\n"

    limit = sizes.METHODS
    overrides = "    void g() override;\n    A();\n    ~A();\n    A(const A&) = delete;\n"
    assert not refused({"src/a/a.hpp": full(limit, overrides), "verify/a.hpp": full(limit + 1), "bindings/cpp/a.hpp": full(limit + 1)})
    wide = [full(limit + 1), full(limit, "    static void g();\n"), full(limit, "    template <class T>\n    void g(T t);\n"),
            full(limit, "    virtual void g() = 0;\n"), full(limit + 1).replace("class A", "template <class T>\nstruct A"),
            "namespace {\n" + full(limit + 1) + "}\n", "class Outer {\n" + full(limit + 1) + "};\n"]
    for text in wide:
        for name in ("src/a/a.hpp", "src/a/a.cpp", "bindings/cli/src/a.cpp"):
            said = refused({name: text})
            assert len(said) == 1 and f"{limit + 1} public methods" in said[0], f"{text}: {said}"

    head = "namespace delam {\ntemplate <class T>\nclass A {\n    A();\n    struct In { int f(); };\n    int g();\n    static int x;\n};\n}\n"
    one = "namespace delam {\ntemplate <class T>\nA<T>::A() : x{1} {}\ntemplate <class T>\nint A<T>::g() { return B::g(); }\n}\n"
    fine = ["namespace delam {\nint A<int>::In::f() { return 1; }\n}\n", "namespace delam {\nint g() { return A<int>::x; }\n}\n",
            "namespace delam {\nint y = A<int>::g(), z{A<int>::g()};\nA<int>::In make() { return {}; }\n}\n",
            "namespace other {\nint A::g() { return 1; }\n}\n", "namespace delam {\ntemplate int A<int>::g();\n}\n",
            "namespace delam {\nnamespace {\nclass A { int g(); };\nint A::g() { return 1; }\n}\n}\n"]
    for text in fine:
        assert not refused({"src/a.hpp": head, "src/a.cpp": one, "src/b.cpp": text}), text
    scattered = ["namespace delam {\ntemplate <class T>\nint A<T>::g() { return 1; }\n}\n", "int delam::A<int>::g() { return 1; }\n",
                 "namespace delam {\nnamespace inner {\n}\nint A<int>::x = 3;\n}\n", "namespace delam {\nint A<int>::x{3};\n}\n",
                 "namespace delam {\nstd::vector<A<int>::In> A<int>::g() const { return {}; }\n}\n",
                 "namespace delam {\nA<int>::A() = default;\n}\n"]
    for text in scattered:
        said = refused({"src/a.hpp": head, "src/a.cpp": one, "src/b.cpp": text})
        assert len(said) == 1 and "members in src/a.cpp, src/b.cpp" in said[0], f"{text}: {said}"
        assert not refused({"src/a.hpp": head, "src/b.cpp": text})
    return 3 * len(wide) + len(scattered) + len(METHODS)


def main():
    found = list(scanner.functions(CODE))
    assert found == EXPECTED, f"found {found}, expected {EXPECTED}"
    refused = {
        "a wide line": ("verify/a.jl", "x" * 121 + "\n"),
        "a long function": ("src/a/b.cpp", lengthy(81)),
        "a long function after a constructor": ("src/a/b.cpp", "A::A() : a_{1} {}\n" + lengthy(81)),
        "a long function in a class": ("src/a/b.hpp", "class A {\n" + lengthy(81) + "};\n"),
        "a long function for C": ("src/a/b.cpp", 'extern "C" {\n' + lengthy(81) + "}\n"),
        "a long file": ("src/a/b.cpp", "int a;\n" * 501),
        "a long test": ("verify/a/test_b.cpp", "int a;\n" * 501),
        "a long script": ("verify/a/b.sh", "true\n" * 501),
        "a long function of a test": ("verify/a/b.c", lengthy(81)),
        "a long test in a test": ("verify/a/b.cpp", "TEST(a) {\n" + "    g();\n" * 79 + "}\n"),
        "a long function of Python": ("verify/a/b.py", "def f():\n" + "    g()\n" * 80),
        "a long README": ("verify/a/README.md", "- a\n" * 41),
        "a wide README": ("verify/a/README.md", "| " + "x" * 121 + " |\n" + "x" * 121 + "\n"),
    }
    for what, (name, text) in refused.items():
        assert len(list(sizes.problems(name, text))) == 1, f"{what} was not refused"
    fine = {
        "a full line": ("verify/a.jl", "x" * 120 + "\n"),
        "a full function": ("src/a/b.cpp", lengthy(80)),
        "two functions": ("src/a/b.cpp", lengthy(80) + lengthy(80)),
        "a long function elsewhere": ("bindings/b.cpp", lengthy(200)),
        "a long function of a host that was released": ("verify/kept/8aed94c5/hosts/b.c", lengthy(200)),
        "a full file": ("src/a/b.cpp", "int a;\n" * 500),
        "a full README": ("verify/a/README.md", "| " + "x" * 121 + " |\n" + "- a\n" * 39),
    }
    for what, (name, text) in fine.items():
        assert not list(sizes.problems(name, text)), f"{what} was refused"
    for lines, more, what in ((120, 0, None), (121, 0, "at most 120"), (119, 0, "lower it"), (80, 0, "lower it"),
                              (120, 81, "at most 80")):
        text = lengthy(lines) + (lengthy(more) if more else "")
        said = list(sizes.problems("verify/b.cpp", text, {"verify/b.cpp": [120]}))
        assert len(said) == (what is not None) and all(what in line for line in said), f"{lines}, {more}: {said}"
    planted = {
        "a cast": "auto* c = dynamic_cast<Condensed*>(op);\n",
        "a copy of index()": "std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }\n",
        "a copy of index() under another name": "inline size_t at(Index i) { return static_cast<size_t>(i); }\n",
        "a copy of max_abs()": "double m = 0.0;\nfor (const double v : values) m = std::max(m, std::abs(v));\n",
        "a choice of the stiffness": "const double k = c == 0 ? p->normal_stiffness : p->tangential_stiffness;\n",
        "a test of the mixity rule": 'if (o.mixity_rule == "frozen") return;\n',
        "a test of the mixity rule, turned": 'if ("converged" != o->mixity_rule) return;\n',
        "the word of the mixity rule": "const std::string& rule = problem.options.mixity_rule;\n",
    }
    for what, text in planted.items():
        assert list(words.problems("src/a/b.cpp", text, words.RULES)), f"{what} was not refused"
        assert not list(words.problems("src/a/b.cpp", "// " + text.replace("\n", " "), words.RULES)), f"{what} in a comment was refused"
    twin = {"src/a.cpp": "constexpr double far = 1e-3, near = 2.0;  // far = 5.0\n",
            "src/b.cpp": "static constexpr std::int64_t far = 1e-3;\ninline constexpr double near = 3.0;\n"}
    assert [line.split(":")[0] for line in words.twins(twin)] == ["far = 1e-3 stands in src/a.cpp, src/b.cpp"]
    twin = {"src/a.cpp": "constexpr double noticeable = 0.01;", "bindings/cli/src/b.cpp": "constexpr double noticeable = 0.02;"}
    assert list(words.twins(twin)) == ["noticeable has 2 values: 0.01, 0.02"]
    with tempfile.TemporaryDirectory() as folder:
        src = pathlib.Path(folder) / "src"
        (src / "law").mkdir(parents=True)
        (src / "README.md").write_text("One folder.\n", encoding="utf-8")
        (src / "law" / "mixity.cpp").touch()
        (src / "law" / "law_kind.hpp").touch()
        (src / "law" / "shape").mkdir()
        (src / "law" / "shape" / "linear.hpp").touch()
        missing = "named in no README of its folder or of one above it"
        assert list(readmes.problems(src)) == ["src/law: no README.md",
                                               *(f"src/law/{name}: {missing}" for name in ("law_kind", "mixity", "shape/linear"))]
        (src / "law" / "README.md").write_text("- `mixity`\n- `law`\n- `linear`\n", encoding="utf-8")
        assert list(readmes.problems(src)) == [f"src/law/law_kind: {missing}"]
        (src / "law" / "README.md").write_text("- `mixity`, `law_kind`, `linear`\n", encoding="utf-8")
        assert not list(readmes.problems(src))
        (src / "law" / "names.hpp").write_text("// See src/law/mixity.cpp, src/lost.cpp and examples/NAME/NAME.toml.\n",
                                               encoding="utf-8")
        assert list(readmes.lost(src.parent, ["src/law/names.hpp"])) == ["src/law/names.hpp: src/lost.cpp is not there"]
    assert len(names.findings("import os\n\n\ndef f():\n    return lost\n", "a.py")) == 2
    assert not names.findings("import os  # noqa: F401\n", "a.py")
    houses = planted_steps() + planted_arrows() + planted_imports() + planted_sentences() + planted_english() + planted_classes()
    print(f"{len(EXPECTED)} functions, {len(refused) + 4 + len(planted) + 4 + houses} planted")
    return 0


if __name__ == "__main__":
    sys.exit(main())
