// SPDX-License-Identifier: BSD-3-Clause
// callback_statuses HEADER...: whatever an engine or a law of the host returns, in whichever of its calls, the running
// function returns a status that its line in brackets lists, with the callback's message, and leaves everything as it
// was. The lists are read from the headers; which of the listed statuses has to come back is stated here once more.
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "contract.hpp"
#include "dense_engine.hpp"
#include "host_law.hpp"

namespace {

using namespace fuzz;

constexpr std::int32_t returned[] = {DELAM_NOT_CONVERGED,
                                     DELAM_CANCELLED,
                                     DELAM_LIMIT,
                                     4,
                                     77,
                                     std::numeric_limits<std::int32_t>::max(),
                                     DELAM_ERROR_ARGUMENT,
                                     DELAM_ERROR_HANDLE,
                                     DELAM_ERROR_MESH,
                                     DELAM_ERROR_PROBLEM,
                                     DELAM_ERROR_STATE,
                                     DELAM_ERROR_MEMORY,
                                     DELAM_ERROR_NUMERICAL,
                                     DELAM_ERROR_SNAPSHOT,
                                     DELAM_ERROR_INTERNAL,
                                     DELAM_ERROR_FILE,
                                     -11,
                                     std::numeric_limits<std::int32_t>::min()};

int checks = 0, failures = 0;

void check(bool holds, const std::string& what) {
    ++checks;
    if (holds) return;
    ++failures;
    std::printf("failed: %s\n", what.c_str());
}

// Function -> statuses of its line in brackets.
std::map<std::string, std::set<std::int32_t>> lists_of(int count, char** headers) {
    std::map<std::string, std::int32_t> number;
    for (std::int32_t status = DELAM_ERROR_FILE; status <= DELAM_LIMIT; ++status) {
        std::string word = std::string(delam_status_name(status)).substr(std::string("DELAM_").size());
        if (word.rfind("ERROR_", 0) == 0) word = word.substr(6);
        for (char& c : word) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        number[word] = status;
    }
    std::map<std::string, std::set<std::int32_t>> lists;
    for (int i = 0; i < count; ++i) {
        std::ifstream file(headers[i]);
        std::string text{std::istreambuf_iterator<char>(file), {}};
        for (std::size_t at; (at = text.find("\n * ")) != std::string::npos;) text.replace(at, 4, " ");
        const std::string declares = "DELAM_API int32_t ";
        for (std::size_t at = text.find(declares); at != std::string::npos; at = text.find(declares, at + 1)) {
            const std::size_t name = at + declares.size(), end = text.rfind("*/", at);
            std::size_t place = text.rfind("; status ", end);
            if (const std::size_t first = text.rfind("[status ", end);
                place == std::string::npos || (first != std::string::npos && first > place))
                place = first;
            place = text.find("status ", place) + 7;
            const std::string list = text.substr(place, text.find_first_of(";]", place) - place) + ",";
            std::string word;
            std::set<std::int32_t>& own = lists[text.substr(name, text.find('(', name) - name)];
            for (const char c : list) {
                if (c != ',' && c != ' ') {
                    word += c;
                } else {
                    if (number.count(word) != 0) own.insert(number[word]);
                    word.clear();
                }
            }
        }
    }
    return lists;
}

// Two layers with an interface, held at the left and pulled apart there; the law is the host's.
struct Scene {
    Host host;
    HostLaw law_data;
    DenseEngine engine{Dense()};
    delam_mesh* mesh = nullptr;
    delam_law* law = nullptr;
    delam_problem* problem = nullptr;
    delam_solver* solver = nullptr;
    std::vector<std::uint8_t> earlier, later;

    void good(std::int32_t status) {
        if (status == DELAM_OK) return;
        std::printf("the scene is refused: %d %s\n", status, delam_context_message(host.context));
        std::exit(1);
    }
    Scene(bool with_engine, bool law_of_host) {
        const double length = 1.0, thickness[] = {0.25, 0.25}, across[] = {1.0, 0.0}, up[] = {0.0, 1.0};
        const std::int64_t cells = 4, layers[] = {1, 1};
        std::int64_t interface = 0, load = 0;
        good(delam_mesh_create_layers(host.context, 2, &length, &cells, 2, thickness, layers, DELAM_QUAD4, &mesh));
        good(delam_mesh_add_interface(mesh, 0, 1, 0.0, &interface));
        if (law_of_host) {
            good(delam_law_create_host(host.context, "bilinear", host_adhesion, host_dissipation, &law_data, &law));
        } else {
            good(delam_law_create(host.context, "piecewise-linear", &law));
            for (const char* direction : {"normal", "tangential"}) {
                good(delam_law_set(law, (std::string(direction) + "_onset").c_str(), 0.01));
                good(delam_law_set(law, (std::string(direction) + "_toughness").c_str(), 0.05));
            }
        }
        good(delam_law_set(law, "normal_stiffness", 1e4));
        good(delam_law_set(law, "tangential_stiffness", 1e4));
        good(delam_problem_create(host.context, mesh, &problem));
        good(delam_problem_set_elastic(problem, -1, 1e5, 0.25));
        good(delam_problem_set_law(problem, interface, law));
        const std::int64_t notch = 0;
        const double open = 0.0;
        good(delam_problem_set_adhesion(problem, interface, 1, &notch, &open, 0));
        const double times[] = {0.0, 1.0}, factors[] = {0.0, 1.0};
        good(delam_problem_add_pattern(problem, "load", 2, times, factors, &load));
        const std::int64_t low[] = {0, 5}, high[] = {15};
        const double amount = 0.012;
        good(delam_problem_prescribe_nodes(problem, 2, low, across, 0, nullptr, nullptr, 0));
        good(delam_problem_prescribe_nodes(problem, 2, low, up, 0, nullptr, nullptr, 0));
        good(delam_problem_prescribe_nodes(problem, 1, high, up, 1, &load, &amount, 0));
        good(delam_problem_set_text(problem, "mixity_rule", "frozen"));
        if (with_engine) {
            engine.take(stiffness_of(mesh, problem));
            const delam_experimental_engine functions = engine.functions();
            good(delam_experimental_problem_set_engine(problem, &functions));
        }
        good(delam_solver_create(problem, 0.0, &solver));
        earlier = saved(solver);
        for (const double time : {0.5, 0.75}) {
            good(delam_solver_advance(solver, time));
            good(delam_solver_commit(solver));
        }
        later = saved(solver);
    }
    ~Scene() {
        delam_solver_destroy(&solver);
        delam_problem_destroy(&problem);
        delam_law_destroy(&law);
        delam_mesh_destroy(&mesh);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
};

struct Call {
    const char* function;
    std::function<std::int32_t(Scene&)> make;
    bool of_engine, of_law;
    std::function<void(Scene&)> before = nullptr;
};

std::int32_t value(Scene& s, const char* key) {
    double number = 0.0;
    return delam_solver_value(s.solver, key, &number);
}

void pend(Scene& s) {
    std::int32_t pending = 0;
    delam_solver_pending(s.solver, &pending);
    if (pending == 0) s.good(delam_solver_advance(s.solver, 0.8));
}

// A state of which nothing has been asked yet.
void load(Scene& s) { s.good(delam_solver_load(s.solver, static_cast<std::int64_t>(s.later.size()), s.later.data())); }

// The state of time 0, in which parameters may be followed.
void begin_anew(Scene& s) {
    delam_solver_destroy(&s.solver);
    s.good(delam_solver_create(s.problem, 0.0, &s.solver));
}

std::int32_t create(Scene& s) {
    delam_solver* made = nullptr;
    const std::int32_t status = delam_solver_create(s.problem, 0.0, &made);
    delam_solver_destroy(&made);
    return status;
}

std::int32_t create_like(Scene& s) {
    delam_solver* made = nullptr;
    const std::int32_t status = delam_solver_create_like(s.problem, s.solver, 0.0, &made);
    delam_solver_destroy(&made);
    return status;
}

const Call calls[] = {
    {"delam_solver_create", create, true, true},
    {"delam_solver_create_like", create_like, true, true},
    {"delam_solver_advance", [](Scene& s) { return delam_solver_advance(s.solver, 0.8); }, true, true},
    {"delam_solver_equilibrate", [](Scene& s) { return delam_solver_equilibrate(s.solver, 0.9, nullptr); }, true, true},
    {"delam_solver_value", [](Scene& s) { return value(s, "kkt_equilibrium"); }, true, false},
    {"delam_solver_value", [](Scene& s) { return value(s, "rotation_max"); }, true, false},
    {"delam_solver_value", [](Scene& s) { return value(s, "energy_release_rate"); }, false, true, load},
    {"delam_solver_field",
     [](Scene& s) {
         std::vector<double> u(40);
         return delam_solver_field(s.solver, "displacement", -1, 40, u.data());
     },
     true, false},
    {"delam_solver_average",
     [](Scene& s) {
         double volume = 0.0;
         return delam_solver_average(s.solver, -1, &volume, nullptr, nullptr);
     },
     true, false},
    {"delam_solver_tangent",
     [](Scene& s) {
         double one = 0.0;
         return delam_solver_tangent(s.solver, 1, &one);
     },
     true, false},
    {"delam_solver_step_tangent",
     [](Scene& s) {
         double one = 0.0;
         return delam_solver_step_tangent(s.solver, 1, &one);
     },
     true, true, pend},
    {"delam_solver_commit", [](Scene& s) { return delam_solver_commit(s.solver); }, false, true,
     [](Scene& s) {
         load(s);
         s.good(delam_solver_record(s.solver, "energy_release_rate"));
         pend(s);
     }},
    {"delam_solver_record", [](Scene& s) { return delam_solver_record(s.solver, "energy_release_rate"); }, false, true,
     load},
    {"delam_solver_front_count",
     [](Scene& s) {
         std::int64_t fronts = 0;
         return delam_solver_front_count(s.solver, 0, &fronts, nullptr);
     },
     false, true, load},
    {"delam_solver_front",
     [](Scene& s) {
         double places[8];
         return delam_solver_front(s.solver, 0, 4, 4, nullptr, nullptr, places, nullptr, nullptr, nullptr, nullptr,
                                   nullptr);
     },
     false, true, load},
    {"delam_experimental_solver_recover", [](Scene& s) { return delam_experimental_solver_recover(s.solver); }, true,
     false},
    {"delam_experimental_solver_follow",
     [](Scene& s) {
         const std::int64_t interface = 0;
         return delam_experimental_solver_follow(s.solver, 1, &interface, "normal_stiffness", nullptr);
     },
     false, true, begin_anew},
    {"delam_law_check", [](Scene& s) { return delam_law_check(s.law); }, false, true},
    {"delam_law_toughness",
     [](Scene& s) {
         const double half = 0.5;
         double onset = 0.0;
         return delam_law_toughness(s.law, 1, &half, &onset, nullptr);
     },
     false, true},
    {"delam_law_respond",
     [](Scene& s) {
         const double jump[] = {0.003, 0.0}, half = 0.5, one = 1.0;
         double adhesion = 0.0;
         return delam_law_respond(s.law, 2, 1, jump, &half, &one, &adhesion, nullptr);
     },
     false, true},
    {"delam_problem_set_law", [](Scene& s) { return delam_problem_set_law(s.problem, 0, s.law); }, false, true},
    {"delam_problem_check", [](Scene& s) { return delam_problem_check(s.problem); }, false, true},
    {"delam_problem_process_zone",
     [](Scene& s) {
         double length = 0.0;
         return delam_problem_process_zone(s.problem, 0, &length, nullptr);
     },
     false, true},
    {"delam_problem_propose",
     [](Scene& s) {
         double strength = 0.0;
         return delam_problem_propose(s.problem, 0, 3.0, nullptr, nullptr, &strength, nullptr);
     },
     false, true},
    {"delam_problem_plan",
     [](Scene& s) {
         const char* plan = nullptr;
         return delam_problem_plan(s.problem, &plan, nullptr, nullptr);
     },
     false, true},
};

// Returns the status that has to come back: by experimental.h for an engine, by delam.h DELAM_ERROR_PROBLEM for a law.
std::int32_t wanted(const std::set<std::int32_t>& listed, std::int32_t given, bool engine) {
    const std::set<std::int32_t> of_engines = {DELAM_CANCELLED,   DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM,
                                               DELAM_ERROR_STATE, DELAM_ERROR_MEMORY,   DELAM_ERROR_NUMERICAL};
    std::int32_t status = engine ? given : DELAM_ERROR_PROBLEM;
    if (of_engines.count(status) == 0) status = DELAM_ERROR_NUMERICAL;
    if (status == DELAM_ERROR_MEMORY || listed.count(status) != 0) return status;
    for (const std::int32_t instead : {DELAM_ERROR_NUMERICAL, DELAM_ERROR_PROBLEM})
        if (listed.count(instead) != 0) return instead;
    return DELAM_ERROR_INTERNAL;
}

// Fails in the k-th call of a callback, for each k until the call ends before; returns how many there were.
int provoke(const Call& call, const std::set<std::int32_t>& listed, bool engine) {
    Scene scene(engine, !engine);
    if (call.before != nullptr) call.before(scene);
    int met = 0;
    for (std::int64_t k = 0; k < 400; k += 1 + k / 8) {
        bool reached = true;
        for (const std::int32_t given : returned) {
            if (call.before != nullptr && given == returned[0] && k > 0) call.before(scene);
            const std::vector<std::uint8_t> before = saved(scene.solver);
            scene.engine.failed = scene.law_data.failed = false;
            (engine ? scene.engine.fail_in : scene.law_data.fail_in) = k;
            (engine ? scene.engine.fail_with : scene.law_data.fail_with) = given;
            const std::int32_t status = call.make(scene);
            scene.engine.fail_in = scene.law_data.fail_in = -1;
            reached = engine ? scene.engine.failed : scene.law_data.failed;
            if (!reached) break;
            ++met;
            const std::string where = std::string(call.function) + ", call " + std::to_string(k) + " of the " +
                                      (engine ? "engine" : "law") + " returns " + std::to_string(given);
            check(status == wanted(listed, given, engine), where + ": status " + std::to_string(status) +
                                                               ", expected " +
                                                               std::to_string(wanted(listed, given, engine)));
            check(listed.count(status) != 0 || status == DELAM_ERROR_MEMORY || status == DELAM_ERROR_INTERNAL,
                  where + ": status " + std::to_string(status) + " is not listed");
            const std::string message = delam_context_message(scene.host.context);
            check(message.find(engine ? "as asked" : "callback failed with " + std::to_string(given)) !=
                      std::string::npos,
                  where + ": the message is '" + message + "'");
            check(saved(scene.solver) == before, where + ": the solver has changed");
        }
        if (!reached) break;
    }
    return met;
}

}  // namespace

int main(int argc, char** argv) {
    const auto lists = lists_of(argc - 1, argv + 1);
    for (const Call& call : calls)
        for (const bool engine : {true, false}) {
            if (!(engine ? call.of_engine : call.of_law)) continue;
            const auto listed = lists.find(call.function);
            if (listed == lists.end()) {
                check(false, std::string(call.function) + " has no line in brackets");
                continue;
            }
            const int met = provoke(call, listed->second, engine);
            check(met > 0,
                  std::string(call.function) + ": no callback of the " + (engine ? "engine" : "law") + " runs");
            std::printf("%s: %d failures of the %s\n", call.function, met, engine ? "engine" : "law");
        }
    std::printf("%d checks, %d failures\n", checks, failures);
    return failures == 0 && checks > 1000 ? 0 : 1;
}
