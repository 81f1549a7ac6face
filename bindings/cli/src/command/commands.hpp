// SPDX-License-Identifier: BSD-3-Clause
// The subcommands; each returns an exit code or throws a Failure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/library/model.hpp"
#include "text/unit.hpp"

namespace cli {

class Bulk;

// An analysis leaves these to the next one of the same process, for the condensed bodies of its solver, which many
// studies do not vary.
struct Former {
    Context context;
    Solver solver;
};

// Called around everything for which solvers of the model exist: it calls the rest of the command and returns its exit
// code. Empty: the command calls the rest itself. For programs that solve the bodies elsewhere.
using Around = std::function<int(const Model& model, const std::function<int()>& rest)>;
// The program whose commands these are: how people call it, what it does around solvers, where the fields of nodes and
// cells are (null: here), and what the analysis before has left (null: nobody asks).
struct Caller {
    std::string name = "delam";
    Around around{};
    Bulk* bulk = nullptr;
    Former* former = nullptr;
};

// settings: KEY=VALUE, see setting.hpp. command: the line as typed, for result.json.
int run(const std::string& scene_file, const std::vector<std::string>& settings, const std::string& folder, bool resume,
        const std::string& command, const Caller& caller);
// Writes the scene of an Abaqus input file; scene_file "": to standard output. replace: also where there is a file.
int import(const std::string& deck, const std::string& scene_file, bool replace);
// A study is a Python script of share/delam/study, which runs the program again for each analysis.
struct Study {
    std::string name;  // "sweep", "fit" or "evaluate"
    std::vector<std::string> scenes;
    std::vector<std::string> settings;  // for all runs
    std::string folder;
    bool replace = false;
    std::int64_t jobs = 1;
    std::vector<std::string> vary;  // of a sweep
    std::int64_t latin = 0, seed = 1;
    std::vector<std::string> data, parameters, columns, specimen;  // of a fit
    std::string x = "load", y = "reaction", weights = "curve", width, loops = "cut", slack = "find", compliance;
    double scale = 1.0, x_scale = 1.0, confidence = 0.95, held = 0.1;
    std::string test, crack, marks, beside, sheets;  // of an evaluation
    std::map<std::string, std::string> sheet;
    std::vector<std::string> units, calibration, leave_out;
};
int study(const Study& study);
// Runs analyses for a study, one after another in this process: each line of standard input names one, and its exit
// code becomes a line of standard output. Returns when there are no more lines.
int serve(const Caller& caller);
// Becomes a Python script of share/delam, which gets these words.
[[noreturn]] void start_script(const std::string& name, const std::string& words);

// A row of a specimen's sheet: an option of `delam new`.
struct SheetRow {
    const char* name;
    const Unit* unit;  // in which the script gets it
    const char* example;
    const char* meaning;
};
std::vector<SheetRow> sheet_rows();
// "1.5mm" as a number of the row's unit.
double sheet_number(const SheetRow& row, const std::string& text);
// Kinds of specimens, and the scene that is made of one.
inline const std::vector<std::string> specimen_kinds{"dcb", "enf", "4enf", "mmb", "adcb", "slb", "fibre", "laminate"};
struct SpecimenWishes {
    std::string kind, out, layup, command;
    std::map<std::string, std::string> values;  // by the name of the row, as typed
    std::int64_t steps = 100;
    bool replace = false;
};
int new_scene(const SpecimenWishes& wishes);
// Marks a folder as one of the studies (file/own_files.hpp); refuses if one of the names is there, but no marker.
// known: a folder of an older study, which wrote no marker, is recognised.
int claim(const std::string& folder, const std::vector<std::string>& names, bool known);
// Removes folders of results of a study; removes none of them if one holds anything else.
int discard(const std::vector<std::string>& folders);
// Lists the options of [solver] and the parameters of the laws.
int options(bool json);
struct CheckWishes {
    bool json = false;     // one object instead of lines, also for a wrong scene
    bool no_plan = false;  // without what an analysis takes, whose prediction is most of the work
    std::string drawing;   // a file for a drawing of the scene; "": none
};
int check(const std::string& scene_file, const std::vector<std::string>& settings, const CheckWishes& wishes,
          const Caller& caller);

}  // namespace cli
