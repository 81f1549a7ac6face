// SPDX-License-Identifier: BSD-3-Clause
#include "api.hpp"

namespace reference {
namespace {

Context make_context() {
    delam_context* raw = nullptr;
    const std::int32_t status = delam_context_create(&raw);
    if (status != DELAM_OK) throw Failure(status, "delam_context_create failed");
    return Context(raw);
}

std::int64_t length(const std::vector<double>& values) { return static_cast<std::int64_t>(values.size()); }
std::int64_t length(const std::vector<std::int64_t>& values) { return static_cast<std::int64_t>(values.size()); }

}  // namespace

Scene::Scene(int dimension, const std::vector<double>& lengths, const std::vector<std::int64_t>& divisions,
             const std::vector<double>& thickness, const std::vector<std::int64_t>& layer_divisions,
             std::int32_t cell_type)
    : dimension_(dimension), context_(make_context()) {
    delam_mesh* raw = nullptr;
    require(delam_mesh_create_layers(context(), dimension, lengths.data(), divisions.data(), length(thickness),
                                     thickness.data(), layer_divisions.data(), cell_type, &raw),
            "delam_mesh_create_layers");
    mesh_.reset(raw);
    adopt_mesh();
}

Scene::Scene(int dimension, const std::vector<double>& nodes) : dimension_(dimension), context_(make_context()) {
    delam_mesh* raw = nullptr;
    require(delam_mesh_create(context(), dimension, length(nodes) / dimension, nodes.data(), &raw),
            "delam_mesh_create");
    mesh_.reset(raw);
}

Scene::Scene(int dimension, const std::vector<double>& nodes, std::int32_t cell_type,
             const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& bodies)
    : Scene(dimension, nodes) {
    require(delam_mesh_add_cells(mesh(), cell_type, static_cast<std::int64_t>(bodies.size()), cells.data(),
                                 bodies.data(), 0),
            "delam_mesh_add_cells");
    adopt_mesh();
}

Scene Scene::conforming(int dimension, const std::vector<double>& nodes, std::int32_t cell_type,
                        const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& bodies) {
    return conforming(dimension, nodes, {{cell_type, cells, bodies}});
}

Scene Scene::conforming(int dimension, const std::vector<double>& nodes, const std::vector<Cells>& cells) {
    Scene scene(dimension, nodes);
    for (const Cells& block : cells)
        REQUIRE(scene, delam_mesh_add_conforming_cells, scene.mesh(), block.type,
                static_cast<std::int64_t>(block.bodies.size()), block.nodes.data(), block.bodies.data(), 0);
    scene.adopt_mesh();
    return scene;
}

Scene Scene::adopt(Context context, Mesh mesh, Problem problem, std::vector<InterfaceStiffness> stiffness) {
    Scene scene;
    scene.context_ = std::move(context);
    scene.mesh_ = std::move(mesh);
    scene.problem_ = std::move(problem);
    scene.stiffness_ = std::move(stiffness);
    std::int32_t dimension = 0;
    REQUIRE(scene, delam_mesh_size, scene.mesh(), &dimension, nullptr, nullptr, nullptr, nullptr);
    scene.dimension_ = dimension;
    scene.adopt_mesh();
    return scene;
}

void Scene::adopt_mesh() {
    std::int64_t count = 0;
    require(delam_mesh_size(mesh(), nullptr, &count, nullptr, nullptr, nullptr), "delam_mesh_size");
    nodes_.resize(static_cast<std::size_t>(count * dimension_));
    require(delam_mesh_nodes(mesh(), length(nodes_), nodes_.data()), "delam_mesh_nodes");
}

void Scene::require(std::int32_t status, const char* call) const {
    if (status == DELAM_OK) return;
    throw Failure(status,
                  std::string(call) + ": " + delam_status_name(status) + ": " + delam_context_message(context()));
}

std::int64_t Scene::all_interfaces() {
    std::int64_t count = -1;
    require(delam_mesh_add_all_interfaces(mesh(), 0.0, &count), "delam_mesh_add_all_interfaces");
    adopt_mesh();
    return count;
}

std::int64_t Scene::interface(std::int32_t body_a, std::int32_t body_b) {
    std::int64_t index = -1;
    require(delam_mesh_add_interface(mesh(), body_a, body_b, 0.0, &index), "delam_mesh_add_interface");
    adopt_mesh();
    return index;
}

std::int64_t Scene::projected(std::int32_t body_a, std::int32_t body_b, double gap) {
    std::int64_t index = -1;
    require(delam_mesh_add_projected_interface(mesh(), body_a, body_b, gap, &index),
            "delam_mesh_add_projected_interface");
    adopt_mesh();
    return index;
}

std::int64_t Scene::obstacle(const std::vector<std::int64_t>& nodes, const std::vector<double>& normals,
                             std::int64_t control_node) {
    std::int64_t index = -1;
    require(
        delam_mesh_add_obstacle(mesh(), length(nodes), nodes.data(), normals.data(), nullptr, control_node, 0, &index),
        "delam_mesh_add_obstacle");
    return index;
}

void Scene::begin() {
    delam_problem* raw = nullptr;
    require(delam_problem_create(context(), mesh(), &raw), "delam_problem_create");
    problem_.reset(raw);
    std::int64_t interfaces = 0;
    require(delam_mesh_size(mesh(), nullptr, nullptr, nullptr, nullptr, &interfaces), "delam_mesh_size");
    stiffness_.resize(static_cast<std::size_t>(interfaces));
    text("kinematics", "linear");  // as in the reference solvers
}

void Scene::elastic(std::int32_t body, double young, double poisson) {
    require(delam_problem_set_elastic(problem(), body, young, poisson), "delam_problem_set_elastic");
}

void Scene::law(std::int64_t interface_index, const LawData& data) {
    delam_law* raw = nullptr;
    require(delam_law_create(context(), "piecewise-linear", &raw), "delam_law_create");
    laws_.emplace_back(raw);
    const auto set = [&](const char* key, double value) { require(delam_law_set(raw, key, value), key); };
    set("normal_stiffness", data.normal_stiffness);
    set("tangential_stiffness", data.tangential_stiffness);
    set("normal_onset", data.normal_onset);
    set("tangential_onset", data.tangential_onset);
    set("normal_toughness", data.normal_toughness);
    set("tangential_toughness", data.tangential_toughness);
    set("onset_exponent_1", data.exponent);
    set("onset_exponent_2", data.exponent);
    set("toughness_exponent_1", data.exponent);
    set("toughness_exponent_2", data.exponent);
    if (data.gradient > 0.0) set("gradient", data.gradient);
    for (const auto& [key, value] : {std::pair("second_tangential_stiffness", data.second_tangential_stiffness),
                                     std::pair("second_tangential_onset", data.second_tangential_onset),
                                     std::pair("second_tangential_toughness", data.second_tangential_toughness)})
        if (value > 0.0) set(key, value);
    require(delam_problem_set_law(problem(), interface_index, raw), "delam_problem_set_law");
    stiffness_[static_cast<std::size_t>(interface_index)] = {data.normal_stiffness, data.tangential_stiffness, false,
                                                             data.second_tangential_stiffness};
}

void Scene::bonded(std::int64_t interface_index) {
    require(delam_problem_set_bonded(problem(), interface_index), "delam_problem_set_bonded");
    stiffness_[static_cast<std::size_t>(interface_index)] = {0.0, 0.0, true};
}

void Scene::adhesion(std::int64_t interface_index, const std::vector<std::int64_t>& pairs,
                     const std::vector<double>& values) {
    require(delam_problem_set_adhesion(problem(), interface_index, length(pairs), pairs.data(), values.data(), 0),
            "delam_problem_set_adhesion");
}

std::int64_t Scene::pattern(const char* name, const std::vector<double>& times, const std::vector<double>& values) {
    std::int64_t index = -1;
    require(delam_problem_add_pattern(problem(), name, length(times), times.data(), values.data(), &index),
            "delam_problem_add_pattern");
    return index;
}

void Scene::hold(const std::vector<std::int64_t>& nodes, const std::vector<double>& direction) {
    require(
        delam_problem_prescribe_nodes(problem(), length(nodes), nodes.data(), direction.data(), 0, nullptr, nullptr, 0),
        "delam_problem_prescribe_nodes");
}

void Scene::drive(const std::vector<std::int64_t>& nodes, const std::vector<double>& direction, std::int64_t pattern,
                  const std::vector<double>& coefficients) {
    require(delam_problem_prescribe_nodes(problem(), length(nodes), nodes.data(), direction.data(), 1, &pattern,
                                          coefficients.data(), 0),
            "delam_problem_prescribe_nodes");
}

void Scene::equation(const std::vector<std::int64_t>& nodes, const std::vector<double>& coefficients,
                     std::int64_t pattern, double coefficient) {
    require(delam_problem_add_equation(problem(), length(nodes), nodes.data(), coefficients.data(), pattern < 0 ? 0 : 1,
                                       &pattern, &coefficient, 0),
            "delam_problem_add_equation");
}

void Scene::periodic(const std::vector<double>& periods, const std::vector<std::int64_t>& control_nodes) {
    require(delam_problem_add_periodic(problem(), length(control_nodes), periods.data(), control_nodes.data(), 0.0, 0),
            "delam_problem_add_periodic");
}

void Scene::contact(std::int64_t interface_index) {
    require(delam_problem_set_contact(problem(), interface_index), "delam_problem_set_contact");
    stiffness_[static_cast<std::size_t>(interface_index)] = {0.0, 0.0, false};
}

void Scene::number(const char* key, double value) { require(delam_problem_set_number(problem(), key, value), key); }

void Scene::text(const char* key, const char* value) { require(delam_problem_set_text(problem(), key, value), key); }

std::vector<std::int64_t> Scene::find(std::int32_t body, const std::vector<double>& lower,
                                      const std::vector<double>& upper) const {
    std::vector<std::int64_t> found(node_count());
    std::int64_t count = 0;
    require(delam_mesh_find_nodes(mesh(), body, lower.data(), upper.data(), length(found), found.data(), &count),
            "delam_mesh_find_nodes");
    found.resize(static_cast<std::size_t>(count));
    return found;
}

Pairs Scene::pairs(std::int64_t interface_index) const {
    std::int64_t count = 0;
    require(delam_mesh_interface_size(mesh(), interface_index, nullptr, nullptr, &count, nullptr, nullptr),
            "delam_mesh_interface_size");
    const auto n = static_cast<std::size_t>(count);
    const auto d = static_cast<std::size_t>(dimension_);
    Pairs p{std::vector<std::int64_t>(n), std::vector<std::int64_t>(n), std::vector<double>(n),
            std::vector<double>(n * d * d)};
    require(delam_mesh_interface_pairs(mesh(), interface_index, p.node_a.data(), p.node_b.data(), p.weight.data(),
                                       p.frame.data()),
            "delam_mesh_interface_pairs");
    return p;
}

std::size_t Scene::pair_count() const {
    std::size_t total = 0;
    for (std::size_t i = 0; i < stiffness_.size(); ++i) total += pairs(static_cast<std::int64_t>(i)).count();
    return total;
}

Solver::Solver(const Scene& scene, double time) : scene_(&scene) {
    delam_solver* raw = nullptr;
    REQUIRE(scene, delam_solver_create, scene.problem(), time, &raw);
    handle_.reset(raw);
}

void Solver::step(double time) { scene_->require(advance(time), "delam_solver_advance"); }

void Solver::commit() { REQUIRE(*scene_, delam_solver_commit, get()); }

void Solver::rollback() { REQUIRE(*scene_, delam_solver_rollback, get()); }

void Solver::equilibrate(double time, const std::vector<double>& adhesion) {
    REQUIRE(*scene_, delam_solver_equilibrate, get(), time, adhesion.empty() ? nullptr : adhesion.data());
}

double Solver::value(const std::string& key) const {
    double value = 0.0;
    scene_->require(delam_solver_value(get(), key.c_str(), &value), key.c_str());
    return value;
}

std::vector<double> Solver::values() const {
    std::int64_t count = 0;
    REQUIRE(*scene_, delam_solver_value_count, get(), &count);
    std::vector<double> all;
    for (std::int64_t i = 0; i < count; ++i) all.push_back(value(delam_solver_value_name(get(), i)));
    return all;
}

std::vector<double> Solver::field(const char* key) const {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    scene_->require(delam_solver_field_shape(get(), key, -1, &rows, &columns), key);
    std::vector<double> values(static_cast<std::size_t>(rows * columns));
    scene_->require(delam_solver_field(get(), key, -1, length(values), values.data()), key);
    return values;
}

std::vector<std::uint8_t> Solver::save() const {
    std::int64_t needed = 0;
    REQUIRE(*scene_, delam_solver_save, get(), 0, nullptr, &needed);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(needed));
    REQUIRE(*scene_, delam_solver_save, get(), needed, bytes.data(), &needed);
    return bytes;
}

std::int32_t Solver::load(const std::vector<std::uint8_t>& bytes) {
    return delam_solver_load(get(), static_cast<std::int64_t>(bytes.size()), bytes.data());
}

}  // namespace reference
