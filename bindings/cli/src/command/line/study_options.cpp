// SPDX-License-Identifier: BSD-3-Clause
#include "command/line/study_options.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "command/help/command_text.hpp"

namespace cli {

namespace {

constexpr double largest_factor = 1e150;  // its square is a number

// A number from `low` to `high`. CLI::Range takes what is no number, and infinities where they are a bound.
CLI::Validator number_within(double low, double high, const std::string& allowed) {
    return {[=](const std::string& text) {
                double value = 0;
                if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high && (value != 0 || low == 0))
                    return std::string();
                return fmt::format("{:.40}: {} is expected", text, allowed);
            },
            ""};
}

// A value of an option that takes several, each time one of them.
template <class Value>
CLI::Option* add_several(CLI::App& command, const char* names, std::vector<Value>& into, const char* meaning) {
    return command.add_option(names, into, meaning)->allow_extra_args(false);
}

void add_sweep(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.sweep =
        app.add_subcommand("sweep", "run a scene with many values, several at once, into one table and pictures");
    of.sweep->add_option("scene", study.scenes, "scene file")->type_name(scene_value)->required()->expected(1);
    add_several(*of.sweep, "--vary", study.vary,
                "FROM:TO:NUMBER, FROM:TO:NUMBER:log, a list A,B,C or, with --latin, FROM:TO, e.g. "
                "laws.0.normal_toughness=200:400:5; given several times, all combinations are run")
        ->type_name("KEY=VALUES")
        ->required();
    of.sweep->add_option("--latin", study.latin, "a Latin hypercube of so many points in the ranges instead")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, 1000000));
    of.sweep->add_option("--seed", study.seed, "of --latin (default 1)")
        ->type_name("NUMBER")
        ->check(CLI::Range(0, 2147483647));
    of.sweep
        ->add_option("--out,-o", into.folder,
                     "folder for table, pictures and results; the same command goes on after an interruption")
        ->type_name(folder_value)
        ->required();
    of.sweep->add_flag("--replace", into.replace, "discard the runs of another sweep in the folder");
    of.sweep->footer(footer);
}

// Adds the option that chooses a test of a file with several.
void add_specimen(CLI::App& command, Study& study) {
    add_several(
        command, "--specimen", study.specimen,
        "which test of a file that has several: its name, or its number from 1 on; one for all files, or one for "
        "each")
        ->type_name("NAME");
}

void add_confidence(CLI::App& command, Study& study) {
    command.add_option("--confidence", study.confidence, "of the intervals (default 0.95)")
        ->type_name("LEVEL")
        ->check(number_within(0.01, 0.9999, "a number from 0.01 to 0.9999"));
}

void add_fit(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.fit = app.add_subcommand("fit", "find numbers of the scene, above all of its laws, from measured load curves");
    of.fit->add_option("scenes", study.scenes, "scene files that share the parameters")
        ->type_name(scene_value)
        ->required();
    of.fit->add_option("--data", study.data, "a CSV file with a curve for each scene, in its order")
        ->type_name(file_value)
        ->required();
    of.fit
        ->add_option(
            "--parameters", study.parameters,
            "KEY, KEY=LOWER:UPPER or KEY=LOWER:UPPER@START, e.g. laws.0.normal_toughness=100:500; the start is "
            "otherwise the value of the scene")
        ->type_name("KEY")
        ->required();
    of.fit->add_option("--x", study.x, "column of history.csv over which the curve is given (default load)")
        ->type_name("COLUMN");
    of.fit->add_option("--y", study.y, "column that is fitted (default reaction)")->type_name("COLUMN");
    of.fit
        ->add_option("--columns", study.columns,
                     "columns of the data (default: those whose titles say displacement and load, or the first two)")
        ->type_name("X Y")
        ->expected(2);
    add_specimen(*of.fit, study);
    of.fit
        ->add_option("--width", study.width,
                     "width of the specimen, by which the y of the data is divided, where a plane scene has forces per "
                     "width; with its own unit if the scene names units, e.g. 25mm")
        ->type_name("WIDTH");
    const auto factor =
        number_within(-largest_factor, largest_factor, "a finite number other than 0, of at most 1e150");
    of.fit->add_option("--scale", study.scale, "factor on the y of the data")->type_name("NUMBER")->check(factor);
    of.fit->add_option("--x-scale", study.x_scale, "factor on the x of the data")->type_name("NUMBER")->check(factor);
    of.fit
        ->add_option("--loops", study.loops,
                     "unloadings of the data: cut (default), or follow, as the load history of the scene")
        ->type_name("HOW")
        ->check(CLI::IsMember(of.choices["loops"] = {"cut", "follow"}));
    of.fit
        ->add_option(
            "--slack", study.slack,
            "displacement at which the load begins, which is taken off: find (default), none, or a length, e.g. "
            "0.3mm")
        ->type_name("LENGTH");
    of.fit
        ->add_option("--compliance", study.compliance,
                     "of machine and fixture: displacement per load of the specimen, which is taken off, e.g. 2e-5mm/N")
        ->type_name("COMPLIANCE");
    of.fit
        ->add_option(
            "--weights", study.weights,
            "curve (default): residuals over the largest y of their curve; relative: over their own y; equal: as "
            "they are")
        ->type_name("HOW")
        ->check(CLI::IsMember(of.choices["weights"] = {"curve", "equal", "relative"}));
    add_confidence(*of.fit, study);
    of.fit
        ->add_option("--held", study.held,
                     "by which part numbers of laws and elastic constants that are not among the parameters are moved "
                     "in the end, to say what an error there does, an analysis each (default 0.1; 0: none)")
        ->type_name("PART")
        ->check(number_within(0, 1, "a number from 0 to 1"));
    of.fit->add_option("--out,-o", into.folder, "folder for fit.json, fit.csv and pictures")
        ->type_name(folder_value)
        ->required();
    of.fit->footer(footer);
}

void add_evaluate(CLI::App& app, Arguments& into, Commands& of) {
    Study& study = into.study;
    of.evaluate = app.add_subcommand(
        "evaluate", "toughness by the standards (ISO 15024, ASTM D5528, D7905, D6671) from the file of a test machine");
    of.evaluate->add_option("test", study.test, "dcb, enf or mmb")
        ->type_name("TEST")
        ->required()
        ->check(CLI::IsMember(of.choices["test"] = {"dcb", "enf", "mmb"}));
    of.evaluate
        ->add_option("file", study.data,
                     "a file with displacement, load and, if there is one, crack length; several are a series")
        ->type_name(file_value)
        ->required();
    struct Entry {
        const char *key, *meaning;
    };
    for (const Entry& entry :
         {Entry{"width", "width of the specimen with its unit, e.g. 25mm"}, Entry{"arm", "thickness of one arm"},
          Entry{"thickness", "thickness of both arms together, instead of --arm"},
          Entry{"notch", "length of the starter crack, from the line of load (dcb, mmb) or the support (enf)"},
          Entry{"span", "distance of the outer supports, of enf and mmb"},
          Entry{"half-span", "half of it, instead of --span"},
          Entry{"lever", "from the middle to the load on the lever, of mmb"},
          Entry{"block-pin", "dcb with load blocks: from the middle of the arm to the pin, l1 of ISO 15024"},
          Entry{"block-length", "dcb with load blocks: length of a block, 2 l2 of ISO 15024"},
          Entry{"compliance", "of machine and fixture, which takes its displacement off, e.g. 2e-5mm/N"},
          Entry{"E1", "modulus along the fibres, e.g. 140GPa"}, Entry{"E2", "modulus across them"},
          Entry{"G13", "shear modulus across the thickness"}, Entry{"G12", "the same of a ply, instead of --G13"}})
        of.evaluate->add_option("--" + std::string(entry.key), study.sheet[entry.key], entry.meaning)
            ->type_name("QUANTITY");
    of.evaluate
        ->add_option("--columns", study.columns,
                     "columns of the file (default: those whose titles say displacement and load)")
        ->type_name("X Y")
        ->expected(2);
    of.evaluate->add_option("--units", study.units, "their units, where the file has none, e.g. mm N")
        ->type_name("LENGTH FORCE")
        ->expected(2);
    of.evaluate->add_option("--crack", study.crack, "column with crack lengths (default: that whose title says so)")
        ->type_name("COLUMN");
    of.evaluate
        ->add_option("--marks", study.marks,
                     "a sheet of crack lengths apart, with the time or the displacement of each beside it")
        ->type_name(file_value);
    add_several(
        *of.evaluate, "--specimen", study.specimen,
        "which test of a file that has several: its name, or its number from 1 on; all, or several of them, are a "
        "series")
        ->type_name("NAME");
    of.evaluate
        ->add_option("--sheets", study.sheets,
                     "a table with a row for each specimen of a series: \"Specimen\", and options that differ, e.g. "
                     "\"width (mm)\"")
        ->type_name(file_value);
    add_several(*of.evaluate, "--leave-out", study.leave_out,
                "a specimen that counts for no mean of the series; its row stays, and it is named")
        ->type_name("NAME");
    add_confidence(*of.evaluate, study);
    add_several(*of.evaluate, "--calibration", study.calibration,
                "of enf: a file that was measured at another length of the crack, e.g. 20mm=a20.csv, or 20mm=all.csv:2 "
                "for the second "
                "test of a file; given twice or more")
        ->type_name("LENGTH=FILE");
    of.evaluate->add_option("--beside", study.beside, "folder of a fit, whose toughness stands beside")
        ->type_name(folder_value);
    of.evaluate->add_option("--out,-o", into.folder, "folder for tables and a picture")
        ->type_name(folder_value)
        ->required();
    of.evaluate->add_flag("--replace", into.replace,
                          "replace the evaluation of another test, or of another series, in the folder");
    of.evaluate->footer(footer);
}

}  // namespace

void add_own(CLI::App& app, Arguments& into, Commands& of) {
    of.own = app.add_subcommand("own", "which files are the program's own (study/MANUAL.md)")->group("");
    of.own->add_option("action", into.page)->required()->check(CLI::IsMember({"claim", "discard"}));
    of.own->add_option("names", into.names)->required();
    of.own->add_flag("--known", into.known);
    of.serve = app.add_subcommand("serve", "run analyses of a study")->group("");
}

void add_studies(CLI::App& app, Arguments& into, Commands& of) {
    add_sweep(app, into, of);
    add_fit(app, into, of);
    add_evaluate(app, into, of);
    for (CLI::App* command : {of.sweep, of.fit}) {
        add_settings(*command, into);
        command->add_option("--jobs,-j", into.study.jobs, "runs at once (default 1)")
            ->type_name("NUMBER")
            ->check(CLI::Range(1, 4096));
    }
}

}  // namespace cli
