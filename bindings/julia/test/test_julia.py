#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Julia package without Julia: its raw layer is what the generator makes of the header, the check of its syntax
finds nothing, and finds each break that is planted here.

    test_julia.py FOLDER [all]     keeps the parser there; exit code 77 where it can be neither found nor fetched.
                                   Every fifth break is planted, with `all` (the long tier) each
"""
import gc
import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))

import check_julia  # noqa: E402
import generate_raw  # noqa: E402
import syntax  # noqa: E402
from check_julia import public_header  # noqa: E402

RAW = "src/raw.jl"
HEADER = public_header.read(check_julia.HEADER)
FILES = check_julia.package_files()

# File, what stands there, what is put in its place, words that the check must say.
BREAKS = [
    # argument types
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int32, nodes::Ptr{Cdouble}",
     "'capacity' is integer of 64"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int, nodes::Ptr{Cdouble}", "Int is as wide as"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Clong, nodes::Ptr{Cdouble}", "Clong is as wide as"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Csize_t, nodes::Ptr{Cdouble}", "Csize_t is as wide as"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::UInt64, nodes::Ptr{Cdouble}",
     "'capacity' is integer of 64"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Cdouble, nodes::Ptr{Cdouble}",
     "'capacity' is integer of 64"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Cdouble", "'nodes' is pointer to float"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Ptr{Cfloat}", "'nodes' is pointer to float"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Ptr{Int}", "Int is as wide as"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Ptr{Cvoid}", "'nodes' is pointer to float"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Ptr{Ptr{Cdouble}}",
     "'nodes' is pointer to fl"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes::Vector{Cdouble}", "no type of a ccall"),
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "capacity::Int64, nodes", "has no type"),
    (RAW, "delam_mesh_nodes(mesh::Ptr{delam_mesh}", "delam_mesh_nodes(mesh::Ptr{delam_law}",
     "'mesh' is pointer to handle"),
    (RAW, "delam_mesh_destroy(mesh::Ptr{Ptr{delam_mesh}}", "delam_mesh_destroy(mesh::Ptr{delam_mesh}",
     "pointer to pointer"),
    (RAW, "key::Cstring, value::Cdouble", "key::Ptr{UInt8}, value::Cdouble", "'key' is text"),
    (RAW, "bytes::Ptr{UInt8},", "bytes::Ptr{Int8},", "'bytes' is pointer to byte"),
    (RAW, "callback::delam_log_callback", "callback::delam_progress_callback", "'callback' is callback"),
    (RAW, "callback::delam_log_callback", "callback::Ptr{Cvoid}", "'callback' is callback"),
    # their order and number
    (RAW, "capacity::Int64, nodes::Ptr{Cdouble}", "nodes::Ptr{Cdouble}, capacity::Int64", "'nodes' is 'capacity'"),
    (RAW, "body_a::Int32, body_b::Int32", "body_b::Int32, body_a::Int32", "'body_b' is 'body_a'"),
    (RAW, "mesh::Ptr{delam_mesh}, capacity::Int64, nodes::Ptr{Cdouble}", "mesh::Ptr{delam_mesh}, capacity::Int64",
     "passes 2 arguments, the function takes 3"),
    (RAW, "mesh::Ptr{delam_mesh}, capacity::Int64, nodes::Ptr{Cdouble}",
     "mesh::Ptr{delam_mesh}, capacity::Int64, nodes::Ptr{Cdouble}, more::Int64", "passes 4 arguments"),
    (RAW, "function delam_mesh_nodes(mesh, capacity, nodes)", "function delam_mesh_nodes(mesh, nodes, capacity)",
     "takes (mesh, nodes"),
    (RAW, "function delam_mesh_nodes(mesh, capacity, nodes)", "function delam_mesh_nodes(mesh, capacity)",
     "takes (mesh, capacity)"),
    # names and results
    (RAW, "libdelam.delam_mesh_nodes(", "libdelam.delam_mesh_node(", "calls libdelam.delam_mesh_node"),
    (RAW, "libdelam.delam_mesh_nodes(", "libdelam.delam_mesh_node_bodies(", "calls libdelam.delam_mesh_node_bodies"),
    (RAW, "libdelam.delam_mesh_nodes(", "libother.delam_mesh_nodes(", "calls libother"),
    (RAW, "function delam_mesh_nodes(", "function delam_mesh_all_nodes(", "delam_mesh_nodes of the header is missing"),
    (RAW, "delam_law_check(law::Ptr{delam_law})::Int32", "delam_law_check(law::Ptr{delam_law})::Int64",
     "returns integer of 32"),
    (RAW, "delam_law_check(law::Ptr{delam_law})::Int32", "delam_law_check(law::Ptr{delam_law})::Cvoid",
     "returns integer of 32"),
    (RAW, "delam_law_check(law::Ptr{delam_law})::Int32", "delam_law_check(law::Ptr{delam_law})", "not a single @ccall"),
    (RAW, "libdelam.delam_version()::Cstring", "libdelam.delam_version()::Int32", "returns text"),
    (RAW, "libdelam.delam_option_count()::Int64", "libdelam.delam_option_count()::Int", "Int is as wide as"),
    # constants, handles, callbacks, the list
    (RAW, "const DELAM_TET4 = Int32(3)", "const DELAM_TET4 = Int32(4)", "DELAM_TET4 is Int32(4)"),
    (RAW, "const DELAM_TET4 = Int32(3)", "const DELAM_TET4 = 3", "DELAM_TET4 is 3"),
    (RAW, "const DELAM_TET4 = Int32(3)\n", "", "DELAM_TET4 is missing"),
    (RAW, "const DELAM_TET4 = Int32(3)\n", "const DELAM_TET5 = Int32(3)\n", "DELAM_TET5 is Int32(3)"),
    (RAW, "mutable struct delam_law end\n", "", "handle delam_law: missing"),
    (RAW, "const delam_log_callback = Ptr{Cvoid}", "const delam_log_callback = Cstring", "not Ptr{Cvoid}"),
    (RAW, '"libdelam.so.1"', '"libdelam.so"', "libdelam is not libdelam.so.1"),
    (RAW, ":delam_commit, ", "", "FUNCTIONS are not those"),
    # syntax
    (RAW, "nodes::Ptr{Cdouble})::Int32", "nodes::Ptr{Cdouble}::Int32", "is not parsed"),
    (RAW, "function delam_commit()", "function delam_commit(", "is not parsed"),
    ("src/mesh.jl", "function nodes(mesh::Mesh)", "function nodes(mesh::Mesh", "is not parsed"),
    ("src/solver.jl", "return solver\nend\n\nfunction tell_outcome", "return solver\n\nfunction tell_outcome",
     "is not parsed"),
    ("ext/DelamRecipesBaseExt.jl", "for name in series", "for name series", "is not parsed"),
    # callbacks by hand
    ("src/context.jl", "(Int32, Cstring, Ptr{Cvoid}))::Raw", "(Int64, Cstring, Ptr{Cvoid}))::Raw",
     "'level' is integer of 32"),
    ("src/context.jl", "(Int32, Cstring, Ptr{Cvoid}))::Raw", "(Int32, Cstring))::Raw", "takes 3 arguments, here 2"),
    ("src/context.jl", "@cfunction(on_log, Cvoid,", "@cfunction(on_log, Int32,", "returns void"),
    ("src/context.jl", "@cfunction(on_log, Cvoid,", "@cfunction(on_logs, Cvoid,", "no on_logs"),
    ("src/context.jl", "on_progress(stage::Cstring, done::Int64, total::Int64, user", "on_progress(stage::Cstring, user",
     "no on_progress with 4"),
    ("src/context.jl", "Ptr{Cvoid}))::Raw.delam_log_callback", "Ptr{Cvoid}))", "does not say which callback"),
    ("src/context.jl", "::Raw.delam_log_callback", "::Raw.delam_progress_callback", "delam_progress_callback:"),
    # calls by hand
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "Raw.delam_mesh_nodes(handle, out)",
     "takes 3 arguments, here 2"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "Raw.delam_mesh_nodes(handle, out, length(out))",
     "'nodes' is pointer to float"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "Raw.delam_mesh_node(handle, length(out), out)",
     "is not there"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "delam_mesh_nodes(handle, length(out), out)",
     "without Raw"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "Raw.delam_mesh_nodes(handle, out...)",
     "more than plain"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "Raw.delam_mesh_nodes(handle, C_NULL, out)",
     "'capacity' is integer"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", '@ccall "libdelam".delam_mesh_nodes()::Int32',
     "calls C by itself"),
    ("src/mesh.jl", "Raw.delam_mesh_nodes(handle, length(out), out)", "ccall(:delam_mesh_nodes, Int32, ())",
     "calls C by itself"),
    ("src/law.jl", "Raw.delam_law_check(handle)", "Raw.delam_law_check", "named but not called"),
    ("src/errors.jl", "Raw.DELAM_ERROR_MESH", "Raw.DELAM_ERROR_MASH", "Raw.DELAM_ERROR_MASH is not there"),
    # names and own functions
    ("src/mesh.jl", "return from_one!(found), shares", "return from_one!(fond), shares", "fond is not defined"),
    ("src/interface.jl", "n.nodes_per_face", "n.nodes_pro_face", "a field nodes_pro_face"),
    ("src/mesh.jl", "along(\"direction\", direction, d)", "along(\"direction\", direction)",
     "no method of along takes 2"),
    ("src/mesh.jl", "find_nodes(mesh, place; body=body)", "find_nodes(mesh, place; label=body)",
     "find_nodes takes 2 arguments and label"),
    ("src/Delam.jl", "export Context, ", "export Kontext, ", "Kontext is exported"),
    ("src/Delam.jl", 'include("profile.jl")\n', "", "src/profile.jl is not included"),
    ("examples/enf/enf.jl", "set_elastic!(problem, 75e9, 0.3)", "set_elastic!(problem, 75e9)", "set_elastic! takes 2"),
]


class Generated(unittest.TestCase):
    def test_regenerating_gives_the_committed_file(self):
        self.assertEqual(generate_raw.julia_text(HEADER), generate_raw.RAW.read_text(encoding="utf-8"),
                         "run bindings/julia/tools/generate_raw.py --out bindings/julia/src/raw.jl")


class Parsed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        texts = dict(FILES)
        for number, (file, old, new, _) in enumerate(BREAKS):
            if old not in FILES[file]:
                raise AssertionError(f"{file} has no {old!r}: the break has to be planted anew")
            if number % STRIDE == 0:
                texts[f"break {number}"] = FILES[file].replace(old, new, 1)
        cls.trees = syntax.parse(texts, FOLDER)
        cls.files = {name: cls.trees[name] for name in FILES}

    def test_the_package_agrees_with_the_header(self):
        self.assertEqual(check_julia.Check(HEADER, self.files), [])

    def beside(self, file):
        """What a file is compared with: the raw layer with the header alone, every other file with the package, not with tests."""
        return {} if file == RAW else {name: tree for name, tree in self.files.items() if name.startswith(("src/", "ext/"))}

    def test_every_break_is_found(self):
        for number, (file, old, new, words) in list(enumerate(BREAKS))[::STRIDE]:
            with self.subTest(file=file, old=old, new=new):
                found = check_julia.Check(HEADER, {**self.beside(file), file: self.trees[f"break {number}"]})
                self.assertIn(words, "\n".join(found))

    def test_a_change_of_the_header_is_found(self):
        for old, new, words in (
                ("delam_solver_advance(delam_solver *solver, double time)",
                 "delam_solver_advance(delam_solver *solver)", "delam_solver_advance"),
                ("delam_option_count(void)", "delam_option_number(void)", "delam_option_number of the header is mi"),
                ("#define DELAM_LIMIT 3", "#define DELAM_LIMIT 4", "DELAM_LIMIT")):
            text = check_julia.HEADER.read_text(encoding="utf-8")
            self.assertIn(old, text)
            with self.subTest(old), tempfile.NamedTemporaryFile("w", suffix=".h", encoding="utf-8") as file:
                file.write(text.replace(old, new))
                file.flush()
                found = check_julia.Check(public_header.read(file.name), self.files)
                self.assertIn(words, "\n".join(found))


def main():
    # Millions of nodes that all stay: looking for garbage among them takes half of the time.
    gc.disable()
    try:
        syntax.fetch(FOLDER)
    except syntax.Unavailable as reason:
        # What needs no parser is tested all the same.
        result = unittest.main(argv=sys.argv[:1] + ["Generated"], exit=False).result
        if not result.wasSuccessful():
            sys.exit(1)
        print(f"skipped: the Julia package is neither parsed nor checked: {reason}")
        sys.exit(check_julia.SKIPPED)
    unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    STRIDE = 1 if sys.argv[2:] == ["all"] else 5  # parsing takes most of the time
    FOLDER = pathlib.Path(sys.argv[1])
    del sys.argv[1:]
    main()
