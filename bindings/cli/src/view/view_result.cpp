// SPDX-License-Identifier: BSD-3-Clause
#include "view/view_result.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "file/input_file.hpp"
#include "file/own_files.hpp"
#include "text/error.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

using nlohmann::json;

[[noreturn]] void wrong_result(const std::string& path, const std::string& what) {
    throw Failure(exit_scene, path + ": " + what);
}

// Lists and objects within each other, without reading them.
void require_levels(const std::string& text, const std::string& path) {
    std::size_t levels = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if ((c == '[' || c == '{') && ++levels > most_levels)
            wrong_result(
                path, fmt::format("byte {} begins more than {} lists and objects within each other", i, most_levels));
        if (c == ']' || c == '}') --levels;
    }
}

// A member of result.json that the page shows, and what it must be.
class Member {
public:
    Member(const json& whole, std::string path, std::string key) : path_(std::move(path)), key_(std::move(key)) {
        const json* at = &whole;
        for (std::size_t from = 0; from != std::string::npos;) {
            const std::size_t dot = key_.find('.', from);
            const auto found = at->is_object() ? at->find(key_.substr(from, dot - from)) : at->end();
            if (!at->is_object() || found == at->end()) wrong_result(path_, key_ + " is missing");
            at = &*found;
            from = dot == std::string::npos ? dot : dot + 1;
        }
        value_ = at;
    }

    [[nodiscard]] const json& value() const { return *value_; }
    [[noreturn]] void fail(const std::string& expected) const {
        wrong_result(path_,
                     fmt::format("{} is {}: {} is expected", key_,
                                 shortened(value_->dump(-1, ' ', false, json::error_handler_t::replace)), expected));
    }
    [[nodiscard]] std::string text(std::size_t least = 0) const {
        if (!value_->is_string()) fail("a text");
        std::string out = value_->get<std::string>();
        if (out.size() < least) fail("a text");
        return out;
    }
    [[nodiscard]] std::string one_of(const std::vector<std::string>& known) const {
        const std::string out = text();
        if (std::find(known.begin(), known.end(), out) == known.end()) fail("one of " + listing(known));
        return out;
    }
    [[nodiscard]] std::int64_t whole(std::int64_t least, std::int64_t most) const {
        const std::string expected = fmt::format("a whole number from {} to {}", least, most);
        if (!value_->is_number_integer() || (value_->is_number_unsigned() && value_->get<std::uint64_t>() > INT64_MAX))
            fail(expected);
        const auto out = value_->get<std::int64_t>();
        if (out < least || out > most) fail(expected);
        return out;
    }
    [[nodiscard]] double positive() const {
        if (!value_->is_number() || !(value_->get<double>() > 0) || !(value_->get<double>() <= largest_shown))
            fail("a number > 0");
        return value_->get<double>();
    }
    [[nodiscard]] std::vector<std::string> texts(std::size_t least) const {
        if (!value_->is_array() || value_->size() < least ||
            !std::all_of(value_->begin(), value_->end(), [](const json& one) { return one.is_string(); }))
            fail(least > 0 ? "a list of texts, at least one," : "a list of texts");
        return value_->get<std::vector<std::string>>();
    }

    // Lists of {factor, name} by quantity (result.cpp).
    [[nodiscard]] json scales() const {
        const auto good = [](const json& one) {
            return one.is_object() && one.contains("factor") && one.contains("name") && one["factor"].is_number() &&
                   one["factor"].get<double>() > 0 && one["factor"].get<double>() <= largest_shown &&
                   one["name"].is_string();
        };
        if (!value_->is_object()) fail("an object");
        for (const json& list : *value_)
            if (!list.is_array() || list.empty() || !std::all_of(list.begin(), list.end(), good))
                fail("lists of objects with a factor > 0 and a name");
        return *value_;
    }

private:
    std::string path_, key_;
    const json* value_ = nullptr;
};

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
    const std::string text = read_bytes(path, most_table_bytes);
    if (!text.empty() && text.back() != '\n') wrong_result(path, "its last line has no end: the file was cut");
    out.rows = comma_separated(text);
    if (out.rows.size() < 2) throw Failure(exit_scene, path + ": it has no rows");
    out.titles = std::move(out.rows.front());
    out.rows.erase(out.rows.begin());
    for (std::size_t i = 0; i < out.rows.size(); ++i)
        if (out.rows[i].size() != out.titles.size())
            throw Failure(exit_scene, fmt::format("{}: row {} has {} columns, and its first line names {}", path, i + 1,
                                                  out.rows[i].size(), out.titles.size()));
    return out;
}

// A number that is written out. infinite: it may be inf as well.
double number_of(const std::string& text, bool infinite, const std::string& path, std::size_t row,
                 const std::string& title) {
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool right = code == std::errc() && end == text.data() + text.size() &&
                       (std::abs(value) <= largest_shown || (infinite && std::isinf(value)));
    if (!right)
        wrong_result(path, fmt::format("row {}: {} is \"{}\": a finite number{} is expected", row + 1, title,
                                       shortened(text), infinite ? ", or inf," : ""));
    return value;
}

// Counted, or measured, from 0 on.
const std::set<std::string> never_negative{"step",
                                           "am_iterations",
                                           "linear_iterations",
                                           "contact_pairs",
                                           "backtracks",
                                           "debonded_length",
                                           "revisions",
                                           "search_candidates",
                                           "crack_length",
                                           "process_zone_pairs",
                                           "crack_area",
                                           "process_zone_pairs_mean",
                                           "jumps",
                                           "debonded",
                                           "interface",
                                           "first_pair",
                                           "last_pair",
                                           "before"};
const std::set<std::string> perhaps_infinite{"search_gap", "search_margin"};

const std::set<std::string> drives{"displacement", "force", "strain"};

// Patterns by name; what they drive decides the axes of the page.
std::vector<std::string> pattern_names(const Member& patterns) {
    std::vector<std::string> out;
    const json& list = patterns.value();
    if (!list.is_array()) patterns.fail("a list of patterns");
    for (const json& one : list) {
        if (!one.is_object() || !one.value("name", json()).is_string() || !one.value("drives", json()).is_string() ||
            !drives.contains(one["drives"].get<std::string>()))
            patterns.fail("a name, and drives = displacement, force or strain, of each");
        out.push_back(one["name"].get<std::string>());
    }
    return out;
}

void require_columns(const CommaTable& table, const std::vector<std::string>& needed, const std::string& path) {
    const std::set<std::string> titles(table.titles.begin(), table.titles.end());
    if (titles.size() < table.titles.size()) wrong_result(path, "two of its columns have one title");
    for (const std::string& title : needed)
        if (!titles.contains(title)) wrong_result(path, fmt::format("the column {} is missing", title));
}

}  // namespace

ViewAbout view_about(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code code;
    if (!fs::exists(folder, code)) throw Failure(exit_scene, folder + ": there is no such folder");
    if (!fs::is_directory(folder, code)) throw Failure(exit_scene, folder + ": it is no folder");
    const std::string path = folder + "/result.json";
    if (!is_there(path))
        throw Failure(exit_scene,
                      path + ": there is no such file, so this folder holds no result of delam run" +
                          (fs::exists(folder + "/running", code)
                               ? "; a run is writing there, or was killed (delam run --resume goes on with it)"
                               : ""));
    const std::string bytes = read_bytes(path, most_result_bytes);
    require_levels(bytes, path);
    const json whole = json::parse(bytes, nullptr, false);
    if (!whole.is_object() || whole.value("program", json()) != json("delam"))
        throw Failure(exit_scene, path + ": this is no result of delam run");
    const auto member = [&](const char* key) { return Member(whole, path, key); };

    ViewAbout out;
    const std::string status = member("status").one_of({"complete", "incomplete"});
    const std::int64_t steps = member("steps").whole(1, INT32_MAX);
    out.steps_done = member("steps_done").whole(status == "complete" ? steps : 0, steps);
    out.dimension = static_cast<std::int32_t>(member("scene.dimension").whole(2, 3));
    out.shortest_edge = member("scene.shortest_edge").positive();
    out.scene_hash = member("scene_hash").text(16);
    out.bodies = member("layers").texts(1);
    out.fields = member("output.fields").texts(0);
    out.patterns = pattern_names(member("patterns"));
    const Member failed = member("not_converged");
    std::int64_t last = -1;
    for (const json& one : failed.value()) {
        if (!failed.value().is_array() || !one.is_number_integer() || one.get<std::int64_t>() <= last ||
            one.get<std::int64_t>() > out.steps_done)
            failed.fail(fmt::format("a list of steps from 0 to {}, ascending,", out.steps_done));
        last = one.get<std::int64_t>();
    }
    if (!failed.value().is_array()) failed.fail("a list of steps");
    const Member solution = member("concept");
    if (!solution.value().is_object() || solution.value().empty() ||
        !std::all_of(solution.value().begin(), solution.value().end(), [](const json& v) { return v.is_string(); }))
        solution.fail("an object of texts");
    for (const char* key : {"solution", "mixity_rule", "backtracking", "backtracking_tolerance", "jump_tolerance",
                            "step_control", "mixity_step_tolerance"})
        (void)member((std::string("concept.") + key).c_str()).text(1);
    if (const json& cell = member("cell").value(); !cell.is_null() && !cell.is_object())
        member("cell").fail("null or an object");

    json& shown = out.shown;
    shown = {{"version", member("version").text(1)},
             {"commit", member("commit").text(1)},
             {"status", status},
             {"reason", member("reason").text()},
             {"concept", solution.value()},
             {"steps_done", out.steps_done},
             {"steps", steps},
             {"not_converged", failed.value()},
             {"closing", member("closing").texts(0)},
             {"scene_hash", out.scene_hash},
             {"layers", out.bodies},
             {"patterns", member("patterns").value()},
             {"ended", member("ended").text(1)}};
    for (const char* key : {"length", "force", "time"})
        shown["units"][key] = member((std::string("units.") + key).c_str()).text();
    if (member("units").value().contains("scales")) shown["units"]["scales"] = member("units.scales").scales();
    shown["scene"] = {{"title", member("scene.title").text()},
                      {"file", fs::path(member("scene.file").text()).filename().string()},
                      {"dimension", out.dimension},
                      {"shortest_edge", out.shortest_edge}};
    shown["cell"] = !member("cell").value().is_null();
    shown["displacement_scale"] = member("output.displacement_scale").positive();
    return out;
}

ViewHistory view_history(const std::string& folder, const ViewAbout& about) {
    const std::string path = folder + "/history.csv";
    const CommaTable table = table_of(path);
    std::vector<std::string> needed{"step",       "time", "stored_bulk", "stored_interface",
                                    "dissipated", "work", "solution",    "mixity_rule"};
    for (const std::string& name : about.patterns)
        for (const char* kind : {"load", "reaction"})
            needed.push_back(about.patterns.size() == 1 ? kind : fmt::format("{}_{}", kind, name));
    require_columns(table, needed, path);
    if (static_cast<std::int64_t>(table.rows.size()) != about.steps_done + 1)
        wrong_result(path, fmt::format("it has {} rows, and result.json says that {} steps were computed: {} rows are "
                                       "expected",
                                       table.rows.size(), about.steps_done, about.steps_done + 1));
    ViewHistory out;
    out.columns = json::array();
    for (std::size_t i = 0; i < table.titles.size(); ++i) {
        const std::string& title = table.titles[i];
        if (title == "solution" || title == "mixity_rule") {
            for (std::size_t r = 0; r < table.rows.size(); ++r)
                if (json(table.rows[r][i]) != about.shown["concept"][title])
                    wrong_result(path, fmt::format("row {}: {} is \"{}\", and {} in result.json", r + 1, title,
                                                   shortened(table.rows[r][i]), about.shown["concept"][title].dump()));
            continue;
        }
        json values = json::array();
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const double value = number_of(table.rows[r][i], perhaps_infinite.contains(title), path, r, title);
            if (never_negative.contains(title) && value < 0)
                wrong_result(path, fmt::format("row {}: {} is {}: >= 0 is expected", r + 1, title, value));
            if (title == "step" && value != static_cast<double>(r))
                wrong_result(path, fmt::format("row {}: step is {}, and {} is expected", r + 1, value, r));
            if (title == "time") {
                if (r > 0 && !(value > out.times.back()))
                    wrong_result(
                        path, fmt::format("row {}: time is {} after {}: it must grow", r + 1, value, out.times.back()));
                out.times.push_back(value);
            }
            values.push_back(value);
        }
        out.columns.push_back({{"name", title}, {"values", std::move(values)}});
    }
    return out;
}

json view_jumps(const std::string& folder, const ViewAbout& about, const ViewHistory& history) {
    const std::string path = folder + "/jumps.csv";
    json out = json::array();
    if (!is_there(path)) return out;
    const std::string text = read_bytes(path, most_table_bytes);
    if (text.empty()) wrong_result(path, "it is empty");
    if (text.find('\n') + 1 == text.size()) return out;  // jumps were located, and there is none
    const CommaTable table = table_of(path);
    require_columns(table, {"step", "time", "released", "debonded", "interface", "name"}, path);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        json one = json::object();
        for (std::size_t i = 0; i < table.titles.size(); ++i) {
            const std::string &title = table.titles[i], &word = table.rows[r][i];
            if (title == "name") {
                one[title] = word;
                continue;
            }
            const double value = number_of(word, false, path, r, title);
            if (never_negative.contains(title) && value < 0)
                wrong_result(path, fmt::format("row {}: {} is {}: >= 0 is expected", r + 1, title, value));
            if (title == "step" && (value != std::floor(value) || value > static_cast<double>(about.steps_done)))
                wrong_result(path,
                             fmt::format("row {}: step is {}: 0 to {} are expected", r + 1, value, about.steps_done));
            if (title == "time" && !(value >= history.times.front() && value <= history.times.back()))
                wrong_result(path, fmt::format("row {}: time is {}, and the history goes from {} to {}", r + 1, value,
                                               history.times.front(), history.times.back()));
            one[title] = value;
        }
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace cli
