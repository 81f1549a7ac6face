// SPDX-License-Identifier: BSD-3-Clause
#include "command/help/man_page.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "delam/delam.h"
#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
            out += std::string("\\&") + c;
        else
            out += c;
    }
    return out;
}

std::string upper_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

std::string heading(const std::string& name, int section) {
    return fmt::format(".TH {} {} \"\" \"libdelam {}\" \"libdelam\"\n", upper_case(roff(name)), section,
                       delam_version());
}

std::string option_line(const OptionText& option) {
    std::string out = ".TP\n";
    if (option.argument)
        return out + "\\fI" + roff(option.value) + "\\fR" + (option.several ? " ..." : "") + "\n" +
               roff(option.meaning) + "\n";
    for (std::size_t i = 0; i < option.names.size(); ++i)
        out += (i > 0 ? ", " : "") + std::string("\\fB") + roff(option.names[i]) + "\\fR";
    if (!option.value.empty()) out += " \\fI" + roff(option.value) + "\\fR";
    return out + "\n" + roff(option.meaning) + "\n";
}

std::string bounds(const Range& range) {
    const bool below = std::isfinite(range.lower), above = std::isfinite(range.upper);
    if (below && above)
        return fmt::format("in {}{:.16g}, {:.16g}{}", range.lower_open ? '(' : '[', range.lower, range.upper,
                           range.upper_open ? ')' : ']');
    if (below) return fmt::format("{} {:.16g}", range.lower_open ? ">" : ">=", range.lower);
    return "";
}

std::string list_text(const KeyRow& row) {
    if (row.count.most == 0) return "list";
    if (row.count.least == row.count.most) return fmt::format("list of {}", row.count.least);
    return fmt::format("list of {} {} {}", row.count.least, row.count.between ? "to" : "or", row.count.most);
}

std::string type_text(const KeyRow& row) {
    const std::string choices = fmt::format("{}", fmt::join(row.choices, ", "));
    switch (row.kind) {
        case KeyKind::number:
            return "number " + bounds(*row.range);
        case KeyKind::whole:
        case KeyKind::wholes: {
            const std::string range = row.most == INT64_MAX ? fmt::format(">= {}", row.least)
                                                            : fmt::format("in [{}, {}]", row.least, row.most);
            return row.kind == KeyKind::whole ? "whole number " + range : list_text(row) + ", whole numbers " + range;
        }
        case KeyKind::flag:
            return "true or false";
        case KeyKind::text:
            return "text";
        case KeyKind::choice:
            return choices;
        case KeyKind::numbers:
            return list_text(row) + (row.or_one ? " or one number " : ", numbers ") + bounds(*row.range);
        case KeyKind::texts:
            return choices.empty() ? "list of texts" : "list of " + choices;
        case KeyKind::points:
            return "list of lists of numbers " + bounds(*row.range);
        case KeyKind::table:
            return "table";
        case KeyKind::tables:
            return "list of tables";
    }
    return "";
}

std::string key_text(const KeyRow& row) {
    std::string notes = type_text(row);
    while (!notes.empty() && notes.back() == ' ') notes.pop_back();
    if (row.needed) notes += "; needed";
    if (row.scenes == Scenes::layers) notes += "; without [mesh]";
    if (row.scenes == Scenes::mesh) notes += "; with [mesh]";
    if (!row.initial.empty()) notes += "; default " + row.initial;
    std::string out = fmt::format(".TP\n\\fB{}\\fR ({})\n{}", roff(row.key), roff(notes), roff(row.meaning));
    if (!row.content.empty()) out += fmt::format(", see\n.B {}", upper_case(roff(row.content)));
    return out + "\n";
}

}  // namespace

std::string man_page_of_program(const ProgramText& program) {
    std::string out = heading(program.name, 1);
    out += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", program.name, roff(program.meaning));
    for (const CommandText& command : program.commands) {
        if (&command != &program.commands.front()) out += ".br\n";
        out += fmt::format(".B {} {}\n", program.name, command.name);
        for (const OptionText& option : command.options) {
            std::string shown = option.argument
                                    ? "\\fI" + roff(option.value) + "\\fR"
                                    : "\\fB" + roff(option.names.front()) + "\\fR" +
                                          (option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR");
            if (option.several) shown += " ...";
            if (option.names.front() == "--help" || option.names.front() == "-h") continue;
            out += option.needed ? shown + "\n" : "[" + shown + "]\n";
        }
    }
    out += ".SH COMMANDS\n";
    for (const CommandText& command : program.commands) {
        out += fmt::format(".SS {}\n{}\n", roff(command.name), roff(command.meaning));
        for (const OptionText& option : command.options) out += option_line(option);
    }
    out += ".SH OPTIONS\n";
    for (const OptionText& option : program.options) out += option_line(option);
    out += ".SH FILES AND EXIT CODES\n.nf\n" + roff(program.footer) + ".fi\n";
    return out + ".SH SEE ALSO\n.BR delam\\-scene (5)\n";
}

std::string man_page_of_scenes(const ProgramText& program) {
    std::string out = heading(program.name + "-scene", 5);
    out += fmt::format(".SH NAME\n{}\\-scene \\- scene files of {}, schema 1\n", program.name, program.name);
    out +=
        ".SH DESCRIPTION\n"
        "A scene is a TOML file. It describes bodies, the interfaces between them, loads and the instants of the "
        "load steps, in any\nconsistent set of units. An unknown key, a value of the wrong type and a value out of "
        "range are errors.\n"
        "The tables of the file come first, then what each of them contains.\n"
        "SCENE.md, in the documentation of the package, has explanations and examples.\n";
    for (const KeyTable& table : scene_tables()) {
        out += fmt::format(".SH {}\n{}\n", upper_case(roff(table.name)), roff(table.meaning));
        for (const KeyRow& row : table.rows) out += key_text(row);
    }
    return out + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", program.name);
}

}  // namespace cli
