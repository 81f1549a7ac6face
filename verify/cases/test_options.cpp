// SPDX-License-Identifier: BSD-3-Clause
// The options as a host sees them: every listed option is at its default in a new solver, refuses values outside its
// range, and changes the hash of the scene. No option is named here except the one that affects no digit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// Two cells on top of each other, pulled apart.
Scene pair_of_cells() {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.25);
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 300.0});
    const auto bottom = scene.find(0, {0.0, 0.0}, {1.0, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {1.0, 2.0});
    scene.hold(top, {1.0, 0.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("pull", {0.0, 1.0}, {0.0, 8e-5}), {1.0, 1.0});
    return scene;
}

struct Listed {
    std::string key, type, initial, range;
};

std::vector<Listed> listed() {
    std::vector<Listed> all;
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char *key = "", *type = "", *initial = "", *range = "", *meaning = "";
        cases::expect(delam_option_info(i, &key, &type, nullptr, &initial, &range, &meaning) == DELAM_OK,
                      "an option that was counted is not there");
        cases::expect(std::string(meaning).size() > 10, std::string(key) + ": no meaning");
        all.push_back({key, type, initial, range});
    }
    return all;
}

std::string hash_of(const Scene& scene) {
    char out[17] = "";
    REQUIRE(scene, delam_problem_hash, scene.problem(), out);
    return out;
}

double number_of(const std::string& words) {
    if (words == "2^53") return 9007199254740992.0;
    std::size_t read = 0;
    const double number = std::stod(words, &read);
    cases::expect(read == words.size(), "'" + words + "' is no number");
    return number;
}

// Parses "0 <= value < 1".
struct Range {
    double lower, upper;
    bool with_lower, with_upper;
    explicit Range(const std::string& words) {
        const std::size_t value = words.find(" value ");
        const std::size_t first = words.find(' '), last = words.rfind(' ');
        cases::expect(value != std::string::npos && first < last, "'" + words + "' is no range");
        lower = number_of(words.substr(0, first));
        upper = number_of(words.substr(last + 1));
        with_lower = words.find("<= value") != std::string::npos;
        with_upper = words.find("value <=") != std::string::npos;
    }
};

std::vector<std::string> words_of(const std::string& range) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= range.size();) {
        const std::size_t end = std::min(range.find(" | ", at), range.size());
        words.push_back(range.substr(at, end - at));
        at = end + 3;
    }
    return words;
}

std::int32_t set(const Scene& scene, const Listed& option, double value) {
    return delam_problem_set_number(scene.problem(), option.key.c_str(), value);
}
std::int32_t set(const Scene& scene, const Listed& option, const std::string& word) {
    return delam_problem_set_text(scene.problem(), option.key.c_str(), word.c_str());
}
std::int32_t set_initial(const Scene& scene, const Listed& option) {
    return option.type == "text" ? set(scene, option, option.initial) : set(scene, option, number_of(option.initial));
}

TEST(defaults_are_those_listed) {
    const Scene scene = pair_of_cells();
    const Solver solver(scene, 0.0);
    const std::string untouched = hash_of(scene);
    delam_problem* made = nullptr;
    scene.require(delam_problem_create(scene.context(), scene.mesh(), &made), "delam_problem_create");
    const reference::Problem problem(made);
    for (const Listed& option : listed()) {
        cases::expect(delam_solver_option(solver.get(), option.key.c_str()) != nullptr,
                      option.key + ": a solver does not know it");
        const char* value = delam_problem_option(problem.get(), option.key.c_str());
        const bool same =
            option.type == "text" ? value == option.initial : number_of(value) == number_of(option.initial);
        cases::expect(same, option.key + ": a new problem has " + value + ", the list says " + option.initial);
        scene.require(set_initial(scene, option), option.key.c_str());
        cases::expect(hash_of(scene) == untouched, option.key + ": its default, set, is another scene");
    }
}

TEST(ranges_are_kept) {
    const Scene scene = pair_of_cells();
    const std::string untouched = hash_of(scene);
    std::int64_t index = 0;
    for (const Listed& option : listed()) {
        double lower = 0.0, upper = 0.0;
        std::int32_t lower_open = -1, upper_open = -1;
        const std::int32_t bounded = delam_option_bounds(index++, &lower, &upper, &lower_open, &upper_open);
        cases::expect(bounded == (option.type == "text" ? DELAM_ERROR_ARGUMENT : DELAM_OK), option.key + ": bounds");
        if (option.type == "text") {
            for (const std::string& bad : {std::string("nonsense"), std::string(), option.range})
                cases::expect(set(scene, option, bad) == DELAM_ERROR_ARGUMENT, option.key + " takes '" + bad + "'");
            cases::expect(set(scene, option, 1.0) == DELAM_ERROR_ARGUMENT, option.key + " takes a number");
            continue;
        }
        const Range range(option.range);
        cases::expect(lower == range.lower && upper == range.upper && lower_open == (range.with_lower ? 0 : 1) &&
                          upper_open == (range.with_upper ? 0 : 1),
                      option.key + ": its bounds are not those of " + option.range);
        std::vector<double> bad{range.lower - 1.0, 2.0 * range.upper, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()};
        if (!range.with_lower) bad.push_back(range.lower);
        if (!range.with_upper) bad.push_back(range.upper);
        if (option.type == "integer") bad.push_back(range.lower + 0.5);
        for (const double value : bad)
            cases::expect(set(scene, option, value) == DELAM_ERROR_ARGUMENT,
                          option.key + " takes " + std::to_string(value));
        cases::expect(set(scene, option, std::string("1")) == DELAM_ERROR_ARGUMENT, option.key + " takes a text");
        cases::expect(hash_of(scene) == untouched, option.key + ": what was refused has changed the scene");
        if (range.with_lower) scene.require(set(scene, option, range.lower), option.key.c_str());
        if (range.with_upper) scene.require(set(scene, option, range.upper), option.key.c_str());
        scene.require(set_initial(scene, option), option.key.c_str());
    }
}

TEST(aliases_are_taken) {
    const Scene scene = pair_of_cells();
    const std::vector<Listed> all = listed();
    int aliases = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const char* alias = nullptr;
        REQUIRE(scene, delam_option_alias, static_cast<std::int64_t>(i), &alias);
        if (*alias == '\0') continue;
        ++aliases;
        Listed renamed = all[i];
        renamed.key = alias;
        if (renamed.type == "text")
            scene.require(set(scene, renamed, words_of(renamed.range).back()), alias);
        else
            scene.require(set(scene, renamed, 0.5 * (number_of(renamed.initial) + Range(renamed.range).upper)), alias);
        const Solver solver(scene, 0.0);
        const char* by_alias = delam_solver_option(solver.get(), alias);
        cases::expect(by_alias != nullptr && by_alias != renamed.initial, std::string(alias) + ": it sets nothing");
        const std::string value = by_alias;  // the next call takes the text back
        cases::expect(value == delam_solver_option(solver.get(), all[i].key.c_str()),
                      std::string(alias) + " is not " + all[i].key);
    }
    cases::expect(aliases > 0, "no option has an alias");
}

// Each value of an option gives another scene: all hashes differ. Other words for one value give the same scene.
TEST(hash_changes_with_every_option) {
    const Scene scene = pair_of_cells();
    const std::string untouched = hash_of(scene);
    std::set<std::string> seen{untouched};
    for (const Listed& option : listed()) {
        std::size_t values = 0, scenes = 0;
        const auto check = [&](const std::string& what) {
            const std::string hash = hash_of(scene);
            // A state of a step that followed its load may go on in others, and small rotations where they may grow.
            const bool either = (option.key == "step_control" && what != "adaptive") ||
                                (option.key == "kinematics" && what != "corotational");
            if (option.key == "threads" || option.key == "memory_limit" || either) {
                cases::expect(hash == untouched, option.key + " changes the hash");
                scenes += either && what != "fixed" && what != "linear" ? 1 : 0;
            } else if (hash != untouched) {
                cases::expect(seen.insert(hash).second, option.key + " = " + what + " hashes like another scene");
                ++scenes;
            }
            ++values;
        };
        if (option.type == "text") {
            std::set<std::string> own;
            for (const std::string& word : words_of(option.range)) {
                scene.require(set(scene, option, word), option.key.c_str());
                const Solver solver(scene, 0.0);
                if (own.insert(delam_solver_option(solver.get(), option.key.c_str())).second) check(word);
            }
            cases::expect(own.size() > 1, option.key + " has no choice");
        } else {
            const Range range(option.range);
            const double initial = number_of(option.initial);
            for (const double value : {initial + 1.0, 0.5 * (initial + range.upper), 0.5 * (initial + range.lower)}) {
                const double tried = option.type == "integer" ? std::floor(value) : value;
                if (!(tried > range.lower && tried < range.upper) || tried == initial) continue;
                scene.require(set(scene, option, tried), option.key.c_str());
                check(std::to_string(tried));
            }
            ++values;  // the default, which is not tested here
        }
        cases::expect(values > 1 && (option.key == "threads" || option.key == "memory_limit" || scenes == values - 1),
                      option.key + ": a value of it is no other scene than the default");
        scene.require(set_initial(scene, option), option.key.c_str());
        cases::expect(hash_of(scene) == untouched, option.key + ": back at its default, the scene is another");
    }
}

}  // namespace
