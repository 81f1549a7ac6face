// SPDX-License-Identifier: BSD-3-Clause
// The public C API in C++ style, for verification: owned handles, statuses as exceptions, arrays as vectors.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "delam/delam.h"

// scene.require(function(...), "function")
#define REQUIRE(scene, function, ...) (scene).require(function(__VA_ARGS__), #function)

namespace reference {

// Thrown at any status other than the expected DELAM_OK.
class Failure : public std::runtime_error {
public:
    Failure(std::int32_t status, const std::string& text) : std::runtime_error(text), status_(status) {}
    std::int32_t status() const { return status_; }

private:
    std::int32_t status_;
};

struct Destroy {
    void operator()(delam_context* p) const { delam_context_destroy(&p); }
    void operator()(delam_mesh* p) const { delam_mesh_destroy(&p); }
    void operator()(delam_law* p) const { delam_law_destroy(&p); }
    void operator()(delam_problem* p) const { delam_problem_destroy(&p); }
    void operator()(delam_solver* p) const { delam_solver_destroy(&p); }
};
using Context = std::unique_ptr<delam_context, Destroy>;
using Mesh = std::unique_ptr<delam_mesh, Destroy>;
using Law = std::unique_ptr<delam_law, Destroy>;
using Problem = std::unique_ptr<delam_problem, Destroy>;
using SolverHandle = std::unique_ptr<delam_solver, Destroy>;

// Parameters of the piecewise-linear law, in SI or in the units of the scene.
struct LawData {
    double normal_stiffness, tangential_stiffness;
    double normal_onset, tangential_onset;
    double normal_toughness, tangential_toughness;
    double exponent = 2.0;
    double gradient = 0.0;
    double second_tangential_stiffness = 0.0;  // 0: that of the first tangent
    double second_tangential_onset = 0.0;      // likewise
    double second_tangential_toughness = 0.0;
};

// The properties of an interface that matter in a displacement step.
struct InterfaceStiffness {
    double normal = 0.0;
    double tangential = 0.0;
    bool bonded = false;
    double second = 0.0;  // along the second tangent in space; 0: the same
    double of(int component) const {
        if (component == 0) return normal;
        return component == 2 && second > 0.0 ? second : tangential;
    }
};

// Pairs of one interface as the library exports them.
struct Pairs {
    std::vector<std::int64_t> node_a, node_b;
    std::vector<double> weight;
    std::vector<double> frame;  // [pairs][dim][dim]
    std::size_t count() const { return weight.size(); }
};

// A scene under construction: context, mesh, laws, problem. Add interfaces before begin(), everything else after it.
class Scene {
public:
    Scene(int dimension, const std::vector<double>& lengths, const std::vector<std::int64_t>& divisions,
          const std::vector<double>& thickness, const std::vector<std::int64_t>& layer_divisions,
          std::int32_t cell_type);
    Scene(int dimension, const std::vector<double>& nodes, std::int32_t cell_type,
          const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& bodies);

    // The same from a conforming mesh, whose nodes are doubled.
    static Scene conforming(int dimension, const std::vector<double>& nodes, std::int32_t cell_type,
                            const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& bodies);

    // The same of cells of several types.
    struct Cells {
        std::int32_t type;
        std::vector<std::int64_t> nodes;
        std::vector<std::int32_t> bodies;
    };
    static Scene conforming(int dimension, const std::vector<double>& nodes, const std::vector<Cells>& cells);

    // Adopts existing handles, with the stiffness of each interface; only options can be added.
    static Scene adopt(Context context, Mesh mesh, Problem problem, std::vector<InterfaceStiffness> stiffness);

    std::int64_t interface(std::int32_t body_a, std::int32_t body_b);
    std::int64_t projected(std::int32_t body_a, std::int32_t body_b, double gap = 0.0);
    std::int64_t obstacle(const std::vector<std::int64_t>& nodes, const std::vector<double>& normals,
                          std::int64_t control_node);
    // Adds interfaces between all bodies that touch; returns their number.
    std::int64_t all_interfaces();
    // Creates the problem, with small rotations: those of the other solvers here are, and tests of large ones say so.
    void begin();

    void elastic(std::int32_t body, double young, double poisson);
    void law(std::int64_t interface_index, const LawData& data);
    void bonded(std::int64_t interface_index);
    void adhesion(std::int64_t interface_index, const std::vector<std::int64_t>& pairs,
                  const std::vector<double>& values);
    std::int64_t pattern(const char* name, const std::vector<double>& times, const std::vector<double>& values);
    // Fixed at zero.
    void hold(const std::vector<std::int64_t>& nodes, const std::vector<double>& direction);
    // Driven by one pattern, with one coefficient per node.
    void drive(const std::vector<std::int64_t>& nodes, const std::vector<double>& direction, std::int64_t pattern,
               const std::vector<double>& coefficients);
    // sum of coefficients[i][:] . u_nodes[i] = coefficient * factor of the pattern (-1: 0).
    void equation(const std::vector<std::int64_t>& nodes, const std::vector<double>& coefficients,
                  std::int64_t pattern = -1, double coefficient = 0.0);
    void periodic(const std::vector<double>& periods, const std::vector<std::int64_t>& control_nodes);
    void contact(std::int64_t interface_index);
    void number(const char* key, double value);
    void text(const char* key, const char* value);
    void require(std::int32_t status, const char* call) const;

    int dimension() const { return dimension_; }
    const std::vector<double>& nodes() const { return nodes_; }
    std::size_t node_count() const { return nodes_.size() / static_cast<std::size_t>(dimension_); }
    double coordinate(std::int64_t node, int axis) const {
        return nodes_[static_cast<std::size_t>(node * dimension_ + axis)];
    }
    // Nodes of a body (-1: all) in a box.
    std::vector<std::int64_t> find(std::int32_t body, const std::vector<double>& lower,
                                   const std::vector<double>& upper) const;
    Pairs pairs(std::int64_t interface_index) const;
    std::size_t pair_count() const;

    delam_context* context() const { return context_.get(); }
    delam_mesh* mesh() const { return mesh_.get(); }
    delam_problem* problem() const { return problem_.get(); }
    const std::vector<InterfaceStiffness>& stiffness() const { return stiffness_; }

private:
    Scene() = default;
    Scene(int dimension, const std::vector<double>& nodes);
    void adopt_mesh();

    int dimension_ = 0;
    Context context_;
    Mesh mesh_;
    std::vector<double> nodes_;
    std::vector<Law> laws_;
    Problem problem_;
    std::vector<InterfaceStiffness> stiffness_;
};

// A solver of a scene; the scene must outlive it (its context carries the messages).
class Solver {
public:
    Solver(const Scene& scene, double time);

    // The first form requires DELAM_OK, the second returns the status.
    void step(double time);
    std::int32_t advance(double time) { return delam_solver_advance(handle_.get(), time); }
    void commit();
    void rollback();
    void equilibrate(double time, const std::vector<double>& adhesion);
    double value(const std::string& key) const;
    std::vector<double> values() const;
    std::vector<double> field(const char* key) const;
    std::vector<std::uint8_t> save() const;
    std::int32_t load(const std::vector<std::uint8_t>& bytes);

    delam_solver* get() const { return handle_.get(); }
    const Scene& scene() const { return *scene_; }

private:
    const Scene* scene_;
    SolverHandle handle_;
};

}  // namespace reference
