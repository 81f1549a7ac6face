// SPDX-License-Identifier: BSD-3-Clause
#include "view_result.hpp"

#include <cctype>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "error.hpp"
#include "input_file.hpp"
#include "number.hpp"

namespace cli {

namespace {

using nlohmann::json;

// Keys of result.json that the page shows.
constexpr const char* shown_keys[] = {"version",    "commit",   "status",        "reason",  "concept",
                                      "steps_done", "steps",    "not_converged", "closing", "scene_hash",
                                      "layers",     "patterns", "units",         "ended"};

struct CommaTable {
    std::vector<std::string> titles;
    std::vector<std::vector<std::string>> rows;
};

// Rows of comma-separated values; those in quotes may have commas and ends of lines, and "" for a quote.
std::vector<std::vector<std::string>> comma_separated(std::string_view text) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> row;
    std::string word;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
            word += text[++i];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (quoted || (c != ',' && c != '\n')) {
            word += c;
        } else {
            row.push_back(std::move(word));
            word.clear();
            if (c == ',') continue;
            rows.push_back(std::move(row));
            row.clear();
        }
    }
    if (!word.empty() || !row.empty()) {
        row.push_back(std::move(word));
        rows.push_back(std::move(row));
    }
    return rows;
}

CommaTable table_of(const std::string& path) {
    CommaTable out;
    out.rows = comma_separated(read_bytes(path));
    if (out.rows.size() < 2) throw Failure(exit_scene, path + ": it has no rows");
    out.titles = std::move(out.rows.front());
    out.rows.erase(out.rows.begin());
    for (std::size_t i = 0; i < out.rows.size(); ++i)
        if (out.rows[i].size() != out.titles.size())
            throw Failure(exit_scene, fmt::format("{}: row {} has {} columns, and its first line names {}", path, i + 1,
                                                  out.rows[i].size(), out.titles.size()));
    return out;
}

// Words are left to the summary of the solution.
bool is_word(const std::string& text) {
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 && text != "inf" &&
           text != "nan";
}

json json_section(const json& whole, const std::string& key) {
    const auto found = whole.find(key);
    return found != whole.end() && found->is_object() ? *found : json::object();
}

}  // namespace

json view_about(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code code;
    if (!fs::exists(folder, code)) throw Failure(exit_scene, folder + ": there is no such folder");
    if (!fs::is_directory(folder, code)) throw Failure(exit_scene, folder + ": it is no folder");
    const std::string path = folder + "/result.json";
    if (!fs::exists(path, code))
        throw Failure(exit_scene,
                      path + ": there is no such file, so this folder holds no result of delam run" +
                          (fs::exists(folder + "/running", code)
                               ? "; a run is writing there, or was killed (delam run --resume goes on with it)"
                               : ""));
    const json whole = json::parse(read_bytes(path), nullptr, false);
    if (!whole.is_object() || whole.value("program", json()) != json("delam"))
        throw Failure(exit_scene, path + ": this is no result of delam run");
    json out = json::object();
    for (const char* key : shown_keys) out[key] = whole.value(key, json());
    const json scene = json_section(whole, "scene");
    const json file = scene.value("file", json(""));
    out["scene"] = {{"title", scene.value("title", json(""))},
                    {"file", file.is_string() ? fs::path(file.get<std::string>()).filename().string() : ""},
                    {"dimension", scene.value("dimension", json())},
                    {"shortest_edge", scene.value("shortest_edge", json())}};
    out["cell"] = whole.contains("cell") && !whole["cell"].is_null();
    out["displacement_scale"] = json_section(whole, "output").value("displacement_scale", json(1.0));
    return out;
}

json view_history(const std::string& folder) {
    const CommaTable table = table_of(folder + "/history.csv");
    json out = json::array();
    for (std::size_t i = 0; i < table.titles.size(); ++i) {
        if (is_word(table.rows.front()[i])) continue;
        json values = json::array();
        for (const auto& row : table.rows) values.push_back(number_in(row[i]));
        out.push_back({{"name", table.titles[i]}, {"values", std::move(values)}});
    }
    return out;
}

json view_jumps(const std::string& folder) {
    const std::string path = folder + "/jumps.csv";
    std::error_code code;
    json out = json::array();
    if (!std::filesystem::exists(path, code)) return out;
    const std::string text = read_bytes(path);
    if (text.find('\n') + 1 >= text.size()) return out;  // jumps were looked for, and there is none
    const CommaTable table = table_of(path);
    for (const auto& row : table.rows) {
        json one = json::object();
        for (std::size_t i = 0; i < row.size(); ++i)
            one[table.titles[i]] = table.titles[i] == "name" ? json(row[i]) : json(number_in(row[i]));
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace cli
