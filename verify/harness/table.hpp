// SPDX-License-Identifier: BSD-3-Clause
// A table, printed as aligned text or as JSON.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace harness {

struct Cell {
    Cell(const char* t) : text(t), quoted(true) {}
    Cell(std::string t) : text(std::move(t)), quoted(true) {}
    Cell(int v) : text(std::to_string(v)) {}
    Cell(long v) : text(std::to_string(v)) {}
    Cell(double v);

    std::string text;
    std::string exact;  // of a number, for JSON; the text for people has four digits
    bool quoted = false;
};

struct Table {
    std::string name;
    std::string note;  // the measured quantity
    std::vector<std::string> columns;
    std::vector<std::vector<Cell>> rows;

    void print_text() const;
    void print_json() const;
};

struct Options {
    bool json = false;
    bool quick = false;
    double finest = 0.0;                // m: finer meshes are left out
    std::string scene;                  // a scene file
    std::vector<std::string> settings;  // KEY=VALUE for it
    std::set<std::string> subjects;     // for the table stability: only these
    std::string specimen;               // for tables over several: only this one

    bool wants(const std::string& of_specimen) const { return specimen.empty() || specimen == of_specimen; }
};

Table balance(const Options& options);
Table feti_direct(const Options& options);
Table energetic(const Options& options);
Table jump_instant(const Options& options);
Table sets(const Options& options);
Table stability(const Options& options);
#ifdef DELAM_SCENE_FILES
Table scene_direct(const Options& options);
#endif

// Prints a line on stderr, so that long tables show their progress.
void progress(const std::string& text);

}  // namespace harness
