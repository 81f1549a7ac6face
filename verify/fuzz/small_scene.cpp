// SPDX-License-Identifier: BSD-3-Clause
#include "small_scene.hpp"

#include <cstdio>

namespace fuzz {

namespace {

class Builder {
public:
    explicit Builder(Host& host) : host_(host) {}
    void operator()(std::int32_t status, const char* what) const {
        if (status != DELAM_OK) std::fprintf(stderr, "%s\n", delam_context_message(host_.context));
        expect(status == DELAM_OK, "a correct scene is accepted", what);
    }

private:
    Host& host_;
};

std::vector<std::int64_t> nodes_in(delam_mesh* mesh, std::int32_t body, const double* lower, const double* upper) {
    std::int64_t count = 0;
    delam_mesh_find_nodes(mesh, body, lower, upper, 0, nullptr, &count);
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(count));
    delam_mesh_find_nodes(mesh, body, lower, upper, count, nodes.data(), &count);
    expect(!nodes.empty(), "an end of a layer has nodes", "delam_mesh_find_nodes");
    return nodes;
}

delam_law* small_law(const Builder& built, Host& host, Input& in) {
    static const char* const kinds[] = {"piecewise-linear", "exponential", "trapezoidal", "tabulated", "griffith"};
    static const char* const criteria[] = {"valoroso-champaney", "power", "benzeggagh-kenane"};
    const std::int64_t kind = in.below(5);
    delam_law* law = nullptr;
    built(delam_law_create(host.context, kinds[kind], &law), "delam_law_create");
    built(delam_law_set_text(law, "criterion", criteria[in.below(3)]), "criterion");
    const double ratio = in.flag() ? 1.0 : 2.0;  // of the tangential toughness to the normal one
    const auto set = [&](const char* key, double value) { built(delam_law_set(law, key, value), key); };
    set("normal_stiffness", 1e4);
    set("tangential_stiffness", 1e4);
    if (kind != 4) {
        set("normal_onset", 0.01);
        set("tangential_onset", 0.01 * ratio);
    }
    set("normal_toughness", 0.05);
    set("tangential_toughness", 0.05 * ratio);
    if (kind == 2) set("plateau", 0.25);
    if (in.seldom()) set("gradient", 1e-3);
    if (kind == 3) {
        const double xi[] = {0.0, 0.5, 1.0};
        const double s[] = {1.0, 0.25, 0.0};
        built(delam_law_set_table(law, 3, xi, s), "delam_law_set_table");
    }
    return law;
}

void set_options(const Builder& built, delam_problem* problem, Input& in) {
    static constexpr struct {
        const char* key;
        const char* value;
    } texts[] = {{"solution", "energetic"},       {"backtracking", "on"},         {"minimisation", "alternate"},
                 {"reduction", "feti"},           {"contact", "always"},          {"mixity", "always"},
                 {"mixity_rule", "converged"},    {"mixity_rule", "variational"}, {"step_control", "adaptive"},
                 {"preconditioner", "dirichlet"}, {"preconditioner", "lumped"},   {"scaling", "multiplicity"},
                 {"gluing", "redundant"},         {"reduction", "condensed"}};
    static constexpr struct {
        const char* key;
        double value;
    } numbers[] = {{"jump_tolerance", 0.1},     {"mixity_step_tolerance", 0.1},
                   {"backtracking_depth", 2.0}, {"damage_tolerance", 1e-3},
                   {"subdomains", 3.0},         {"search_limit", 3.0},
                   {"contact_limit", 1.0},      {"minimisation_limit", 2.0},
                   {"linear_limit", 2.0}};
    built(delam_problem_set_number(problem, "minimisation_limit", 100.0), "minimisation_limit");
    built(delam_problem_set_number(problem, "search_limit", 50.0), "search_limit");
    built(delam_problem_set_number(problem, "backtracking_limit", 5.0), "backtracking_limit");
    built(delam_problem_set_number(problem, "linear_limit", 200.0), "linear_limit");
    built(delam_problem_set_number(problem, "smallest_step", 0.1), "smallest_step");
    for (std::int64_t left = in.below(4); left > 0; --left) {
        const std::size_t which = static_cast<std::size_t>(in.below(std::size(texts) + std::size(numbers)));
        if (which < std::size(texts)) {
            built(delam_problem_set_text(problem, texts[which].key, texts[which].value), texts[which].key);
        } else {
            const auto& number = numbers[which - std::size(texts)];
            built(delam_problem_set_number(problem, number.key, number.value), number.key);
        }
    }
}

}  // namespace

SmallScene small_scene(Host& host, Input& in) {
    const Builder built(host);
    SmallScene scene;
    const bool space = in.byte() % 8 == 7;
    const std::int32_t dimension = space ? 3 : 2;
    static constexpr std::int32_t flat[] = {DELAM_QUAD4, DELAM_TRI3, DELAM_QUAD8, DELAM_QUAD9, DELAM_TRI6};
    static constexpr std::int32_t solid[] = {DELAM_HEX8, DELAM_TET4, DELAM_TET10, DELAM_HEX20, DELAM_HEX27};
    const std::int32_t cell = space ? solid[in.below(2)] : flat[in.below(5)];
    const std::int64_t layers = 2 + in.below(2);
    const double lengths[] = {1.0, 0.25};
    const std::int64_t divisions[] = {1 + in.below(space ? 3 : 6), 1};
    const std::vector<double> thickness(static_cast<std::size_t>(layers), 0.25);
    const std::vector<std::int64_t> across(static_cast<std::size_t>(layers), 1);
    built(delam_mesh_create_layers(host.context, dimension, lengths, divisions, layers, thickness.data(), across.data(),
                                   cell, &scene.mesh),
          "delam_mesh_create_layers");
    for (std::int32_t i = 0; i + 1 < layers; ++i) {
        std::int64_t index = -1;
        built(delam_mesh_add_interface(scene.mesh, i, i + 1, 0.0, &index), "delam_mesh_add_interface");
    }
    scene.law = small_law(built, host, in);
    built(delam_problem_create(host.context, scene.mesh, &scene.problem), "delam_problem_create");
    built(delam_problem_set_elastic(scene.problem, -1, 1000.0, 0.25), "delam_problem_set_elastic");
    for (std::int64_t i = 0; i + 1 < layers; ++i) {
        const std::uint8_t how = i == 0 ? std::uint8_t{0} : in.byte();
        if (how % 8 == 6)
            built(delam_problem_set_bonded(scene.problem, i), "delam_problem_set_bonded");
        else if (how % 8 == 7)
            built(delam_problem_set_contact(scene.problem, i), "delam_problem_set_contact");
        else
            built(delam_problem_set_law(scene.problem, i, scene.law), "delam_problem_set_law");
    }
    if (in.flag()) {
        const std::int64_t first = 0;
        const double none = 0.0;
        built(delam_problem_set_adhesion(scene.problem, 0, 1, &first, &none, 0), "delam_problem_set_adhesion");
    }
    const double height = 0.25 * static_cast<double>(layers);
    const double left_lower[] = {0.0, 0.0, 0.0}, left_upper[] = {0.0, space ? 0.25 : 0.25, 0.25};
    const double top_lower[] = {0.0, space ? 0.0 : height, height}, top_upper[] = {0.0, space ? 0.25 : height, height};
    const std::vector<std::int64_t> held = nodes_in(scene.mesh, 0, left_lower, left_upper);
    const std::vector<std::int64_t> loaded =
        nodes_in(scene.mesh, static_cast<std::int32_t>(layers) - 1, top_lower, top_upper);
    for (std::int32_t d = 0; d < dimension; ++d) {
        double direction[3] = {};
        direction[d] = 1.0;
        built(delam_problem_prescribe_nodes(scene.problem, static_cast<std::int64_t>(held.size()), held.data(),
                                            direction, 0, nullptr, nullptr, 0),
              "delam_problem_prescribe_nodes");
    }
    const double times[] = {0.0, 1.0, 2.0};
    const double factors[] = {0.0, 1.0, in.flag() ? -0.5 : 2.0};
    std::int64_t pattern = -1;
    built(delam_problem_add_pattern(scene.problem, "load", 3, times, factors, &pattern), "delam_problem_add_pattern");
    const double amount = in.flag() ? 0.1 : 0.01;
    double direction[3] = {};
    direction[in.byte() % 4 == 3 ? 0 : dimension - 1] = 1.0;
    if (in.seldom()) {
        std::vector<double> forces;
        for (std::size_t i = 0; i < loaded.size(); ++i)
            for (std::int32_t d = 0; d < dimension; ++d) forces.push_back(amount * direction[d]);
        built(delam_problem_add_forces(scene.problem, pattern, static_cast<std::int64_t>(loaded.size()), loaded.data(),
                                       forces.data(), 0),
              "delam_problem_add_forces");
    } else {
        const std::vector<double> coefficients(loaded.size(), amount);
        built(delam_problem_prescribe_nodes(scene.problem, static_cast<std::int64_t>(loaded.size()), loaded.data(),
                                            direction, 1, &pattern, coefficients.data(), 0),
              "delam_problem_prescribe_nodes");
    }
    set_options(built, scene.problem, in);
    return scene;
}

void destroy(SmallScene& scene) {
    delam_mesh_destroy(&scene.mesh);
    delam_law_destroy(&scene.law);
    delam_problem_destroy(&scene.problem);
}

}  // namespace fuzz
