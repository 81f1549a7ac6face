// SPDX-License-Identifier: BSD-3-Clause
#include "command/help/completion.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

// "solver.reduction=" and "solver.reduction=feti": what --set can change by name alone.
std::vector<std::string> settings() {
    std::vector<std::string> out;
    for (const KeyRow& table : scene_tables().front().rows) {
        if (table.kind != KeyKind::table) continue;
        for (const KeyRow& row : scene_table(table.content).rows) {
            const std::string key = table.key + "." + row.key + "=";
            if (row.choices.empty() || row.kind != KeyKind::choice) out.push_back(key);
            if (row.kind == KeyKind::choice)
                for (const std::string& choice : row.choices) out.push_back(key + choice);
        }
    }
    return out;
}

std::string words(const std::vector<std::string>& list) { return fmt::format("{}", fmt::join(list, " ")); }

// A text within single quotes; in fish a backslash quotes them, elsewhere the quotes are left for it.
std::string quoted(const std::string& text, bool fish = false) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'')
            out += fish ? "\\'" : "'\\''";
        else if (c == '\\' && fish)
            out += "\\\\";
        else
            out += c;
    }
    return out + "'";
}

std::vector<std::string> names_of(const std::vector<OptionText>& options) {
    std::vector<std::string> out;
    for (const OptionText& option : options)
        if (!option.argument) out.insert(out.end(), option.names.begin(), option.names.end());
    return out;
}

std::vector<std::string> commands_of(const ProgramText& program) {
    std::vector<std::string> out;
    for (const CommandText& command : program.commands) out.push_back(command.name);
    return out;
}

bool is_file(const OptionText& option) {
    return option.value == scene_value || option.value == deck_value || option.value == file_value;
}

// Returns the proposals of bash for a value; only names of files are quoted.
std::string bash_reply(const OptionText& option) {
    if (!option.choices.empty()) return fmt::format("compgen -W {} -- \"$word\"", quoted(words(option.choices)));
    if (option.value == setting_value) return "compgen -W \"$settings\" -- \"$word\"";
    const std::string folders = "compgen -d -- \"$word\"";
    if (option.value == folder_value) return folders;
    if (option.value == scene_value) return "compgen -f -X '!*.@(toml|inp)' -- \"$word\"; " + folders;
    if (option.value == deck_value) return "compgen -f -X '!*.inp' -- \"$word\"; " + folders;
    return option.value == file_value ? "compgen -f -- \"$word\"" : ":";
}

std::string bash(const ProgramText& program) {
    std::string cases;
    for (const CommandText& command : program.commands) {
        std::string values, argument = ":";
        for (const OptionText& option : command.options) {
            if (option.argument) argument = bash_reply(option);
            if (option.argument || option.value.empty()) continue;
            values += fmt::format("                {}) mapfile -t COMPREPLY < <({}); return ;;\n",
                                  fmt::join(option.names, "|"), bash_reply(option));
        }
        cases += fmt::format(
            "        {})\n            case $last in\n{}            esac\n"
            "            if [[ $word == -* ]]; then\n"
            "                mapfile -t COMPREPLY < <(compgen -W {} -- \"$word\")\n"
            "            else\n                mapfile -t COMPREPLY < <({})\n            fi ;;\n",
            command.name, values, quoted(words(names_of(command.options))), argument);
    }
    return fmt::format(
        "# Completion of {0} for bash.\n"
        "_{0}() {{\n"
        "    local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD - 1]}} settings={1}\n"
        "    # bash takes KEY=VALUE for three words.\n"
        "    if [[ $word == = ]]; then word=\"$last=\" last=${{COMP_WORDS[COMP_CWORD - 2]}};\n"
        "    elif [[ $last == = ]]; then\n"
        "        word=\"${{COMP_WORDS[COMP_CWORD - 2]}}=$word\" last=${{COMP_WORDS[COMP_CWORD - 3]}}\n"
        "    fi\n"
        "    local whole=$word\n"
        "    COMPREPLY=()\n"
        "    if ((COMP_CWORD == 1)); then\n"
        "        mapfile -t COMPREPLY < <(compgen -W {2} -- \"$word\")\n"
        "        return\n"
        "    fi\n"
        "    shopt -q extglob || {{ shopt -s extglob; trap 'shopt -u extglob; trap - RETURN' RETURN; }}\n"
        "    _{0}_values\n"
        "    # Of KEY=VALUE, bash inserts what follows the sign.\n"
        "    if [[ $whole == *=* ]]; then COMPREPLY=(\"${{COMPREPLY[@]#\"${{whole%%=*}}=\"}}\"); fi\n"
        "    if [[ ${{#COMPREPLY[@]}} == 1 && ${{COMPREPLY[0]}} == *= ]]; then compopt -o nospace; fi\n"
        "    if [[ -e ${{COMPREPLY[0]:-}} ]]; then compopt -o filenames; fi\n"
        "}}\n"
        "_{0}_values() {{\n"
        "    case ${{COMP_WORDS[1]}} in\n{3}    esac\n"
        "}}\n"
        "complete -F _{0} {0}\n",
        program.name, quoted(words(settings())),
        quoted(words(commands_of(program)) + " " + words(names_of(program.options))), cases);
}

std::string zsh_values(const OptionText& option) {
    if (!option.choices.empty()) return "(" + words(option.choices) + ")";
    // A value follows the sign of KEY= without a space.
    if (option.value == setting_value) return "{compadd -S \"\" -a open; compadd -a whole}";
    if (option.value != folder_value && !is_file(option)) return " ";
    if (option.value == folder_value) return "_files -/";
    if (option.value == scene_value) return "_files -g \"*.(toml|inp)\"";
    if (option.value == deck_value) return "_files -g \"*.inp\"";
    return "_files";
}

// A text in an argument of _arguments.
std::string zsh_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zsh(const ProgramText& program) {
    std::string list, cases;
    for (const CommandText& command : program.commands) {
        list += "        " + quoted(zsh_text(command.name) + ":" + command.meaning) + "\n";
        cases += fmt::format("        {})\n            _arguments -s", command.name);
        for (const OptionText& option : command.options) {
            const std::string value =
                option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), zsh_values(option));
            if (option.argument) {
                cases += " \\\n                " + quoted("1" + value);
                continue;
            }
            const bool again = option.value == setting_value;
            for (const std::string& name : option.names)
                cases += " \\\n                " +
                         quoted(fmt::format("{}{}[{}]{}", again ? "*" : "", name, zsh_text(option.meaning), value));
        }
        cases += " ;;\n";
    }
    return fmt::format(
        "#compdef {0}\n"
        "# Completion of {0} for zsh.\n"
        "_{0}() {{\n"
        "    local -a commands=(\n{1}    )\n"
        "    local -a settings=({2})\n"
        "    local -a open=(${{(M)settings:#*=}}) whole=(${{settings:#*=}})\n"
        "    if ((CURRENT == 2)); then _describe command commands; return; fi\n"
        "    local command=$words[2]\n"
        "    shift words\n"
        "    ((CURRENT--))\n"
        "    case $command in\n{3}    esac\n"
        "}}\n"
        "_{0} \"$@\"\n",
        program.name, list, words(settings()), cases);
}

std::string fish(const ProgramText& program) {
    std::string out = fmt::format("# Completion of {0} for fish.\ncomplete -c {0} -f\n", program.name);
    for (const CommandText& command : program.commands)
        out += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d {}\n", program.name, command.name,
                           quoted(command.meaning, true));
    for (const CommandText& command : program.commands) {
        const std::string when = quoted("__fish_seen_subcommand_from " + command.name);
        for (const OptionText& option : command.options) {
            std::string values = option.argument || option.value.empty() ? "" : "-x ";
            if (!option.choices.empty())
                values += "-a " + quoted(words(option.choices));
            else if (option.value == setting_value)
                values += "-a " + quoted(words(settings()));
            else if (option.value == folder_value)
                values += "-a '(__fish_complete_directories)'";
            else if (is_file(option))
                values = option.argument ? "-F" : "-r -F";
            std::string names;
            for (const std::string& name : option.names)
                if (!option.argument)
                    names += (name.starts_with("--") ? " -l " : " -s ") + name.substr(name.find_first_not_of('-'));
            out += fmt::format("complete -c {} -n {}{} {} -d {}\n", program.name, when, names, values,
                               quoted(option.meaning, true));
        }
    }
    return out;
}

}  // namespace

const std::vector<std::string>& completion_shells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completion(const ProgramText& program, const std::string& shell) {
    return shell == "bash" ? bash(program) : shell == "zsh" ? zsh(program) : fish(program);
}

}  // namespace cli
