// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/library/call.hpp"
#include "model/library/selection.hpp"
#include "model/notes.hpp"

namespace cli {

namespace {

// A linear equation under construction: sum of coefficients . u = right side.
struct Equation {
    std::vector<std::int64_t> nodes;
    std::vector<double> coefficients;  // [nodes][dimension]

    void add(std::int64_t node, const std::vector<double>& direction, double factor) {
        nodes.push_back(node);
        for (const double d : direction) coefficients.push_back(factor * d);
    }
};

void impose(const Model& model, const Equation& equation, const std::vector<Term>& right, const Place& place) {
    std::vector<std::int64_t> patterns;
    std::vector<double> prescribed;
    for (const Term& term : right) {
        patterns.push_back(static_cast<std::int64_t>(term.pattern));
        prescribed.push_back(term.coefficient);
    }
    call(model.context.get(),
         delam_problem_add_equation(model.problem.get(), static_cast<std::int64_t>(equation.nodes.size()),
                                    equation.nodes.data(), equation.coefficients.data(),
                                    static_cast<std::int64_t>(patterns.size()), patterns.data(), prescribed.data(), 0),
         place);
}

void add_equation(Model& model, const Scene& scene, const EquationData& data) {
    Equation equation;
    for (const EquationTerm& term : data.left) {
        const Selected at = select(model.context.get(), model.mesh.get(), scene, term.where, true);
        note_place(model, scene, term.where, at);
        const double total = std::accumulate(at.weights.begin(), at.weights.end(), 0.0);
        for (std::size_t i = 0; i < at.nodes.size(); ++i)
            equation.add(at.nodes[i], term.direction,
                         term.coefficient * (at.weights.empty() ? 1.0 : at.weights[i] / total));
    }
    impose(model, equation, data.right, data.place);
}

// [nodes][dimension]
std::vector<double> node_coordinates(const Model& model, std::size_t dimension, const Place& place) {
    std::int64_t count = 0;
    call(model.context.get(), delam_mesh_size(model.mesh.get(), nullptr, &count, nullptr, nullptr, nullptr), place);
    std::vector<double> out(static_cast<std::size_t>(count) * dimension);
    call(model.context.get(), delam_mesh_nodes(model.mesh.get(), static_cast<std::int64_t>(out.size()), out.data()),
         place);
    return out;
}

// A small rotation w moves a point at the distance r from its centre by w x r; along a direction d, this is w . (r x
// d). In the plane, w is the first component of its control node.
std::vector<double> lever(const std::vector<double>& r, const std::vector<double>& d) {
    if (r.size() == 2) return {r[0] * d[1] - r[1] * d[0], 0.0};
    return {r[1] * d[2] - r[2] * d[1], r[2] * d[0] - r[0] * d[2], r[0] * d[1] - r[1] * d[0]};
}

// d . (u_node - u_control) - w . (r x d) = 0
void couple(const Model& model, const Scene& scene, const CouplingData& data) {
    const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where);
    const std::int64_t control = control_node(model.context.get(), model.mesh.get(), scene, data.control, data.place);
    const std::vector<double>& centre = scene.controls[data.control].at;
    std::int64_t rotation = -1;
    std::vector<double> coordinates;
    if (data.rotation) {
        rotation = control_node(model.context.get(), model.mesh.get(), scene, *data.rotation, data.place);
        coordinates = node_coordinates(model, centre.size(), data.place);
    }
    for (const std::vector<double>& direction : data.directions)
        for (const std::int64_t node : at.nodes) {
            Equation equation;
            equation.add(node, direction, 1.0);
            equation.add(control, direction, -1.0);
            if (rotation >= 0) {
                std::vector<double> r(centre.size());
                for (std::size_t a = 0; a < r.size(); ++a)
                    r[a] = coordinates[static_cast<std::size_t>(node) * r.size() + a] - centre[a];
                equation.add(rotation, lever(r, direction), -1.0);
            }
            impose(model, equation, {}, data.place);
        }
}

// Dual vectors g_k of the periods in the space of their axes: g_k . p_l = 1 for k = l, else 0. They are the rows of the
// inverse of the matrix whose columns are the periods (at most three), computed by cofactors.
struct Dual {
    std::vector<std::vector<double>> vectors;
    double measure = 0;  // |det periods|
};

Dual dual_of(const CellData& cell) {
    const std::size_t n = cell.periods.size(), dimension = cell.periods.front().size();
    const auto at = [&](std::size_t k, std::size_t a) { return cell.periods[k % n][cell.axes[a % n]]; };
    Dual out;
    out.vectors.assign(n, std::vector<double>(dimension, 0.0));
    const auto cofactor = [&](std::size_t k, std::size_t a) {
        if (n == 1) return 1.0;
        if (n == 2) return (k == a ? 1.0 : -1.0) * at(k + 1, a + 1);
        return at(k + 1, a + 1) * at(k + 2, a + 2) - at(k + 1, a + 2) * at(k + 2, a + 1);
    };
    double determinant = 0, size = 1;
    for (std::size_t a = 0; a < n; ++a) determinant += at(0, a) * cofactor(0, a);
    for (const auto& period : cell.periods)
        size *= std::sqrt(std::inner_product(period.begin(), period.end(), period.begin(), 0.0));
    if (!(std::abs(determinant) > 1e-9 * size))
        throw SceneFailure(cell.place, "periods: they lie in a line or plane, independent ones are expected");
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t a = 0; a < n; ++a) out.vectors[k][cell.axes[a]] = cofactor(k, a) / determinant;
    out.measure = std::abs(determinant);
    return out;
}

struct Nodes {
    std::vector<double> coordinates;
    std::vector<std::int64_t> used;  // those of cells
};

Nodes nodes_of(const Model& model, const CellData& cell) {
    const delam_context* context = model.context.get();
    Nodes out;
    out.coordinates = node_coordinates(model, cell.periods.front().size(), cell.place);
    const auto count = static_cast<std::int64_t>(out.coordinates.size() / cell.periods.front().size());
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(count));
    call(context, delam_mesh_node_bodies(model.mesh.get(), count, bodies.data()), cell.place);
    for (std::int64_t i = 0; i < count; ++i)
        if (bodies[static_cast<std::size_t>(i)] >= 0) out.used.push_back(i);
    return out;
}

struct Extent {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
};

Extent extent_of(const Nodes& nodes, std::size_t axis, std::size_t dimension) {
    Extent out;
    for (const std::int64_t node : nodes.used) {
        const double x = nodes.coordinates[static_cast<std::size_t>(node) * dimension + axis];
        out.lower = std::min(out.lower, x);
        out.upper = std::max(out.upper, x);
    }
    return out;
}

// Rigid motions of the cell: the node nearest to the lower corner is fixed.
std::int64_t corner_node(const Nodes& nodes, std::size_t dimension) {
    std::vector<double> corner(dimension);
    for (std::size_t a = 0; a < dimension; ++a) corner[a] = extent_of(nodes, a, dimension).lower;
    const auto distance = [&](std::int64_t node) {
        double sum = 0;
        for (std::size_t a = 0; a < dimension; ++a)
            sum += nodes.coordinates[static_cast<std::size_t>(node) * dimension + a] - corner[a];
        return sum;
    };
    return *std::min_element(nodes.used.begin(), nodes.used.end(),
                             [&](std::int64_t a, std::int64_t b) { return distance(a) < distance(b); });
}

std::vector<double> unit(std::size_t dimension, std::size_t axis) {
    std::vector<double> out(dimension, 0.0);
    out[axis] = 1.0;
    return out;
}

// The average displacement gradient is H = sum_k u_k (x) g_k with the control nodes' displacements u_k. Equations
// prescribe strain components (H_ii; H_ij + H_ji); stresses s are dead forces F_k = V s g_k; the antisymmetric part is
// fixed.
void add_cell(const Model& model, const Scene& scene, const CellData& cell) {
    const delam_context* context = model.context.get();
    const std::size_t dimension = cell.periods.front().size(), n = cell.periods.size();
    const Dual dual = dual_of(cell);
    std::vector<double> periods;
    std::vector<std::int64_t> controls;
    for (std::size_t k = 0; k < n; ++k) {
        periods.insert(periods.end(), cell.periods[k].begin(), cell.periods[k].end());
        controls.push_back(control_node(context, model.mesh.get(), scene, cell.controls[k], cell.place));
    }
    call(context,
         delam_problem_add_periodic(model.problem.get(), static_cast<std::int64_t>(n), periods.data(), controls.data(),
                                    cell.tolerance, 0),
         cell.place);

    const std::int64_t held = corner_node(nodes_of(model, cell), dimension);
    for (std::size_t a = 0; a < dimension; ++a)
        call(context,
             delam_problem_prescribe_nodes(model.problem.get(), 1, &held, unit(dimension, a).data(), 0, nullptr,
                                           nullptr, 0),
             {cell.place.file, cell.place.path + " holds its lower corner by itself (leave out supports there)",
              cell.place.line});

    const auto gradient = [&](Equation& equation, std::size_t i, std::size_t j, double factor) {
        for (std::size_t k = 0; k < n; ++k)
            if (std::fpclassify(dual.vectors[k][j]) != FP_ZERO)
                equation.add(controls[k], unit(dimension, i), factor * dual.vectors[k][j]);
    };
    for (const std::size_t i : cell.axes)
        for (const std::size_t j : cell.axes) {
            if (j <= i) continue;
            Equation rotation;
            gradient(rotation, i, j, 1.0);
            gradient(rotation, j, i, -1.0);
            impose(model, rotation, {}, cell.place);
        }
    for (std::size_t a = 0; a < dimension; ++a)
        if (std::find(cell.axes.begin(), cell.axes.end(), a) == cell.axes.end())
            call(context,
                 delam_problem_prescribe_nodes(model.problem.get(), static_cast<std::int64_t>(n), controls.data(),
                                               unit(dimension, a).data(), 0, nullptr, nullptr, 0),
                 cell.place);

    const double volume = cell_volume(model, scene);
    for (const CellComponent& component : cell.components) {
        const std::size_t i = component.i, j = component.j;
        if (!component.stress) {
            Equation strain;
            gradient(strain, i, j, 1.0);
            if (i != j) gradient(strain, j, i, 1.0);
            impose(model, strain, component.terms, component.place);
            continue;
        }
        for (const Term& term : component.terms) {
            std::vector<double> forces(n * dimension, 0.0);
            for (std::size_t k = 0; k < n; ++k) {
                forces[k * dimension + i] += term.coefficient * volume * dual.vectors[k][j];
                if (i != j) forces[k * dimension + j] += term.coefficient * volume * dual.vectors[k][i];
            }
            call(context,
                 delam_problem_add_forces(model.problem.get(), static_cast<std::int64_t>(term.pattern),
                                          static_cast<std::int64_t>(n), controls.data(), forces.data(), 0),
                 component.place);
        }
    }
}

}  // namespace

void add_constraints(Model& model, const Scene& scene) {
    for (const EquationData& data : scene.equations) {
        add_equation(model, scene, data);
        note_constraints(model, data.place);
    }
    for (const CouplingData& data : scene.couplings) {
        couple(model, scene, data);
        note_constraints(model, data.place);
    }
    if (!scene.cell) return;
    add_cell(model, scene, *scene.cell);
    note_constraints(model, scene.cell->place);
}

double cell_volume(const Model& model, const Scene& scene) {
    const CellData& cell = *scene.cell;
    const std::size_t dimension = cell.periods.front().size();
    const Nodes nodes = nodes_of(model, cell);
    double volume = dual_of(cell).measure;
    for (std::size_t a = 0; a < dimension; ++a) {
        if (std::find(cell.axes.begin(), cell.axes.end(), a) != cell.axes.end()) continue;
        const Extent extent = extent_of(nodes, a, dimension);
        volume *= extent.upper - extent.lower;
    }
    return volume;
}

std::array<double, 6> cell_strain(const Model& model, const Scene& scene, delam_solver* solver) {
    const CellData& cell = *scene.cell;
    const delam_context* context = model.context.get();
    const std::size_t dimension = cell.periods.front().size();
    const Dual dual = dual_of(cell);
    std::array<std::array<double, 3>, 3> h{};
    for (std::size_t k = 0; k < cell.periods.size(); ++k) {
        const std::int64_t node = control_node(context, model.mesh.get(), scene, cell.controls[k], cell.place);
        std::array<double, 3> u{};
        call(context, delam_solver_field(solver, "displacement", node, static_cast<std::int64_t>(dimension), u.data()),
             cell.place);
        for (std::size_t i = 0; i < dimension; ++i)
            for (std::size_t j = 0; j < dimension; ++j) h[i][j] += u[i] * dual.vectors[k][j];
    }
    return {h[0][0], h[1][1], h[2][2], h[0][1] + h[1][0], h[1][2] + h[2][1], h[0][2] + h[2][0]};
}

}  // namespace cli
