// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/mesh_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/cell_elasticity.hpp"
#include "body/cell_strains.hpp"
#include "body/equal/cell_shape.hpp"
#include "body/equal/row_table.hpp"
#include "linalg/dense/small_solve.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

// Difference of elasticities, relative to their size, from which on stresses are not averaged: plies of a laminate
// differ by 0.5 and more, cells beside each other on an arc by as much as their directions in rad. (Measured by
// verify/bench/constants.py with verify/cases/mesh_error/effectivity.py: half and twice estimate alike.)
constexpr double another_material = 0.3;
constexpr std::size_t in_plane[] = {0, 1, 3};  // xx, yy, xy among all six

using Stress = std::array<double, most_strains>;
// Stresses or their sums, of an even number of entries, which two at a time take fewer instructions.
template <std::size_t count>
using StressRow = std::array<double, count + count % 2>;

// Factor on eta^2. Stresses of quadratic cells, and of hex8 with incompatible modes, are closer to their own nodal
// means than to the solution. (Measured, as verify/cases/mesh_error/effectivity.py prints it: medians of estimated over
// true errors.)
double calibration(CellType type, Formulation formulation) {
    const bool modes = type == CellType::hex8 && formulation == Formulation::incompatible;
    return modes || !cell_row(type).linear() ? 2.0 : 1.0;
}

// Values at the nodes of a cell from those at its Gauss points: the corner functions that fit these best.
class ToNodes {
public:
    explicit ToNodes(CellType type) : points_(quadrature(type).points.size()), nodes_(reference_nodes(type).size()) {
        const CellRow& row = cell_row(type);
        const auto linear = std::find_if(cell_rows.begin(), cell_rows.end(), [&](const CellRow& other) {
            return other.linear() && other.reference == row.reference &&
                   other.topology.dimension == row.topology.dimension;
        });
        const std::size_t functions = points_ == 1 ? 1 : index(row.topology.corners);
        const auto at = [&](const ReferencePoint& point, std::size_t f) {
            return functions == 1 ? 1.0 : shape_values(linear->type, point)[f];
        };
        // N^T N c = N^T s, and the value at a node is N c.
        const Quadrature& gauss = quadrature(type);
        weight_.assign(nodes_ * points_, 0.0);
        for (std::size_t q = 0; q < points_; ++q) {
            std::array<double, 64> normal{};
            std::array<double, 8> fit{};
            for (std::size_t f = 0; f < functions; ++f) {
                fit[f] = at(gauss.points[q], f);
                for (std::size_t g = 0; g < functions; ++g)
                    for (const ReferencePoint& point : gauss.points) normal[f * 8 + g] += at(point, f) * at(point, g);
            }
            small_solve(functions, 8, normal.data(), fit.data());
            for (std::size_t a = 0; a < nodes_; ++a)
                for (std::size_t f = 0; f < functions; ++f)
                    weight_[a * points_ + q] += at(reference_nodes(type)[a], f) * fit[f];
        }
        for (const ReferencePoint& point : gauss.points) shape_.push_back(shape_values(type, point));
    }
    std::size_t points() const { return points_; }
    std::size_t nodes() const { return nodes_; }
    // Weights of the points for the value at a node, [points].
    const double* weights(std::size_t node) const { return &weight_[node * points_]; }
    // Values of the shape functions at a point, [nodes].
    const double* shapes(std::size_t point) const { return shape_[point].data(); }

private:
    std::size_t points_, nodes_;
    std::vector<double> weight_;  // [nodes][points]
    std::vector<ShapeValues> shape_;
};

// Stresses of one cell after another.
class Stresses {
public:
    Stresses(const Mesh& mesh, std::span<const BodyModel> models, std::span<const std::uint8_t> known)
        : mesh_(mesh), models_(models) {
        for (const BodyModel& model : models) elasticity_.emplace_back(model, mesh.dimension());
        which_.assign(index(mesh.cell_count()), -1);
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
            if (known[body(c)] != 0)
                which_[index(c)] = static_cast<std::int32_t>(cells_.number(shape(c), [&] { return strained_cell(c); }));
    }
    void take(std::span<const double> displacement, const TurnedBodies* turned, std::span<const Strain> eigenstrain) {
        displacement_ = displacement;
        turned_ = turned;
        eigenstrain_ = eigenstrain;
    }
    std::size_t strains() const { return mesh_.dimension() == 2 ? 3 : 6; }
    std::span<const double> elasticity(std::int64_t cell) { return elasticity_[body(cell)].matrix(cell); }

    // Finds the stresses at the Gauss points of a cell, in its frame, and their volumes. Returns CellStrains::excess.
    template <std::size_t count>
    double find(std::int64_t cell, std::size_t points, StressRow<count>* stress, double* volume) {
        const std::size_t dim = index(mesh_.dimension());
        std::array<double, 3 * most_cell_nodes> u;
        double* to = u.data();
        if (turned_ != nullptr) {
            to = std::ranges::copy(turned_->local_displacement(cell), to).out;
        } else {
            for (const std::int64_t n : mesh_.cell(cell))
                for (std::size_t i = 0; i < dim; ++i) *to++ = displacement_[index(n) * dim + i];
        }
        const std::span<const double> matrix = elasticity(cell);
        const std::int32_t which = which_[index(cell)];
        if (which < 0) shape(cell);
        which < 0 ? strained_cell(cell).find({u.data(), to}, strains_)
                  : cells_.at(which).find({u.data(), to}, strains_);
        const bool projected = models_[body(cell)].formulation == Formulation::mean_dilatation;
        const Dilatation dilatation = projected ? elasticity_[body(cell)].dilatation(cell) : Dilatation{};
        const Stress prescribed = prescribed_stress(cell, matrix);
        for (std::size_t q = 0; q < points; ++q) {
            for (std::size_t i = 0; i < count; ++i) {
                double sum = strains_.dilatation[q] * dilatation.stress[i] - prescribed[i];
                for (std::size_t j = 0; j < count; ++j)
                    sum += matrix[i * count + j] * strains_.strain[q * most_strains + j];
                stress[q][i] = sum;
            }
            volume[q] = strains_.volume[q];
        }
        return strains_.excess;
    }

private:
    std::size_t body(std::int64_t cell) const { return index(mesh_.cell_body(cell)); }
    // Returns what tells strains of cells apart.
    std::span<const double> shape(std::int64_t cell) {
        shape_.take(mesh_, cell);
        shape_.add(static_cast<double>(models_[body(cell)].formulation));
        shape_.add(elasticity(cell));
        return shape_.row();
    }
    // Returns that of the cell whose shape was taken last.
    StrainedCell strained_cell(std::int64_t cell) {
        return StrainedCell(mesh_.cell_type(cell), shape_.coordinates(), elasticity(cell),
                            models_[body(cell)].formulation);
    }
    // C e*, of which plane stress has the part in the plane alone.
    Stress prescribed_stress(std::int64_t cell, std::span<const double> matrix) {
        Stress stress{};
        if (eigenstrain_.empty()) return stress;
        CellElasticity& elasticity = elasticity_[body(cell)];
        const Axes* axes = elasticity.axes(cell);
        const Strain strain =
            axes == nullptr ? eigenstrain_[body(cell)] : rotated_strain(eigenstrain_[body(cell)], *axes);
        if (strains() == 6) {
            for (std::size_t i = 0; i < 6; ++i)
                for (std::size_t j = 0; j < 6; ++j) stress[i] += matrix[i * 6 + j] * strain[j];
        } else if (models_[body(cell)].plane == Plane::stress) {
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) stress[i] += matrix[i * 3 + j] * strain[in_plane[j]];
        } else {
            const SpaceElasticity& space = elasticity.space(cell);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 6; ++j) stress[i] += space[in_plane[i] * 6 + j] * strain[j];
        }
        return stress;
    }

    const Mesh& mesh_;
    std::span<const BodyModel> models_;
    std::span<const double> displacement_;
    const TurnedBodies* turned_ = nullptr;
    std::span<const Strain> eigenstrain_;
    std::vector<CellElasticity> elasticity_;
    CellShape shape_;
    ByRow<StrainedCell> cells_;
    std::vector<std::int32_t> which_;  // [cells]; -1: not kept
    CellStrains strains_;
};

// The corners of cells, numbered so that corners at one node share a number if their stresses are comparable.
class Corners {
public:
    Corners(const Mesh& mesh, std::span<const std::uint8_t> known, Stresses& stresses) {
        start_.push_back(0);
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c) start_.push_back(start_.back() + mesh.cell(c).size());
        group_.resize(start_.back());
        // The groups of a node, as a list: its first group, and after each group the next.
        std::vector<std::int64_t> first(index(mesh.node_count()), -1), next;
        std::vector<std::int32_t> body;
        std::vector<std::vector<double>> elasticity;  // different ones, by `which`
        std::vector<std::size_t> which;               // [groups]
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
            poll_cancel("recover");
            if (known[index(mesh.cell_body(c))] == 0) continue;
            const std::span<const double> own = stresses.elasticity(c);
            if (elasticity.empty() || !std::equal(own.begin(), own.end(), elasticity.back().begin()))
                elasticity.emplace_back(own.begin(), own.end());
            for (std::size_t a = 0; a < mesh.cell(c).size(); ++a) {
                std::int64_t* group = &first[index(mesh.cell(c)[a])];
                while (*group >= 0 && (body[index(*group)] != mesh.cell_body(c) ||
                                       !comparable(elasticity[which[index(*group)]], elasticity.back())))
                    group = &next[index(*group)];
                if (*group < 0) {
                    *group = static_cast<std::int64_t>(next.size());
                    group_[start_[index(c)] + a] = next.size();
                    next.push_back(-1);
                    body.push_back(mesh.cell_body(c));
                    which.push_back(elasticity.size() - 1);
                } else {
                    group_[start_[index(c)] + a] = index(*group);
                }
            }
        }
        groups_ = next.size();
    }
    std::size_t groups() const { return groups_; }
    // The groups of a cell's nodes.
    const std::size_t* of(std::int64_t cell) const { return &group_[start_[index(cell)]]; }

private:
    static bool comparable(std::span<const double> a, std::span<const double> b) {
        double difference = 0.0, size = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            difference += (a[i] - b[i]) * (a[i] - b[i]);
            size += a[i] * a[i];
        }
        return difference <= another_material * another_material * size;
    }

    std::vector<std::size_t> start_, group_;
    std::size_t groups_ = 0;
};

// Energies of stresses. The compliance is kept as long as the elasticity stays the same.
template <std::size_t strains>
class Compliance {
public:
    void take(std::span<const double> elasticity) {
        if (std::equal(elasticity.begin(), elasticity.end(), elasticity_.begin())) return;
        std::copy_n(elasticity.begin(), strains * strains, elasticity_.begin());
        for (std::size_t k = 0; k < strains; ++k) {
            std::array<double, strains* strains> factor = elasticity_;
            std::array<double, strains> unit{};
            unit[k] = 1.0;
            small_solve(strains, strains, factor.data(), unit.data());
            for (std::size_t i = 0; i < strains; ++i) compliance_[i * strains + k] = unit[i];
        }
    }
    // 1/2 s : C^-1 : s.
    double energy(const StressRow<strains>& stress) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < strains; ++i)
            for (std::size_t j = 0; j < strains; ++j) sum += stress[i] * compliance_[i * strains + j] * stress[j];
        return 0.5 * sum;
    }

private:
    std::array<double, strains * strains> elasticity_{}, compliance_{};
};

template <std::size_t size>
void add_row(double factor, const std::array<double, size>& row, std::array<double, size>& sum) {
    for (std::size_t i = 0; i < size; ++i) sum[i] += factor * row[i];
}

template <std::size_t count>
class Estimate final : public MeshErrorEstimate {
public:
    Estimate(const Mesh& mesh, std::vector<BodyModel> models, std::vector<std::uint8_t> known)
        : mesh_(mesh),
          models_(std::move(models)),
          known_(std::move(known)),
          stresses_(mesh, models_, known_),
          corners_(mesh, known_, stresses_) {
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
            if (is_known(c))
                points_ += to_nodes_.try_emplace(mesh.cell_type(c), mesh.cell_type(c)).first->second.points();
    }

private:
    MeshError estimate(const Moved& cells, std::span<const Strain> eigenstrain) override;
    bool is_known(std::int64_t cell) const { return known_[index(mesh_.cell_body(cell))] != 0; }
    // Calls use(cell, its type's values, its first Gauss point among all).
    void each_cell(const auto& use) {
        std::size_t first = 0;
        for (std::int64_t c = 0; c < mesh_.cell_count(); ++c) {
            poll_cancel("recover");
            if (!is_known(c)) continue;
            const ToNodes& cell = to_nodes_.find(mesh_.cell_type(c))->second;
            use(c, cell, first);
            first += cell.points();
        }
    }

    const Mesh& mesh_;
    std::vector<BodyModel> models_;
    std::vector<std::uint8_t> known_;
    Stresses stresses_;
    Corners corners_;
    std::map<CellType, ToNodes> to_nodes_;
    std::size_t points_ = 0;  // of all cells
};

template <std::size_t count>
MeshError Estimate<count>::estimate(const Moved& cells, std::span<const Strain> eigenstrain) {
    stresses_.take(cells.displacement, cells.turned, eigenstrain);
    MeshError error{std::vector<double>(index(mesh_.cell_count()), std::numeric_limits<double>::quiet_NaN()),
                    std::vector<double>(index(mesh_.cell_count()), 0.0)};
    // Stresses and volumes of all Gauss points, cell after cell.
    std::vector<StressRow<count>> stress(points_);
    std::vector<double> volume(points_);

    // s* at a node: the mean over the cells there, by their volume.
    std::vector<StressRow<count>> mean(corners_.groups(), StressRow<count>{});
    std::vector<double> around(corners_.groups(), 0.0);
    each_cell([&](std::int64_t c, const ToNodes& cell, std::size_t first) {
        const std::size_t* group = corners_.of(c);
        const StressRow<count>* at = &stress[first];
        error.excess[index(c)] = stresses_.template find<count>(c, cell.points(), &stress[first], &volume[first]);
        double own = 0.0;
        for (std::size_t q = 0; q < cell.points(); ++q) own += volume[first + q];
        for (std::size_t a = 0; a < cell.nodes(); ++a) {
            StressRow<count> sum{};
            const double* weight = cell.weights(a);
            for (std::size_t q = 0; q < cell.points(); ++q) add_row(weight[q], at[q], sum);
            if (cells.turned != nullptr) turn_tensor(cells.turned->rotation(c), {sum.data(), count});
            add_row(own, sum, mean[group[a]]);
            around[group[a]] += own;
        }
    });
    for (std::size_t g = 0; g < mean.size(); ++g)
        for (std::size_t i = 0; i < count; ++i) mean[g][i] /= around[g];

    Compliance<count> compliance;
    each_cell([&](std::int64_t c, const ToNodes& cell, std::size_t first) {
        const std::size_t* group = corners_.of(c);
        const StressRow<count>* at = &stress[first];
        compliance.take(stresses_.elasticity(c));
        double sum = 0.0;
        for (std::size_t q = 0; q < cell.points(); ++q) {
            StressRow<count> difference{};
            const double* shape = cell.shapes(q);
            for (std::size_t a = 0; a < cell.nodes(); ++a) add_row(shape[a], mean[group[a]], difference);
            if (cells.turned != nullptr) turn_tensor(transposed(cells.turned->rotation(c)), {difference.data(), count});
            add_row(-1.0, at[q], difference);
            sum += volume[first + q] * compliance.energy(difference);
        }
        sum *= calibration(mesh_.cell_type(c), models_[index(mesh_.cell_body(c))].formulation);
        // Bending that all cells of a layer hide in the same way leaves stresses continuous; the modes see it.
        error.of_cell[index(c)] = std::max(sum, error.excess[index(c)]);
    });
    return error;
}

}  // namespace

std::unique_ptr<MeshErrorEstimate> mesh_error_estimate(const Mesh& mesh, std::vector<BodyModel> models,
                                                       std::vector<std::uint8_t> known) {
    if (mesh.dimension() == 2) return std::make_unique<Estimate<3>>(mesh, std::move(models), std::move(known));
    return std::make_unique<Estimate<6>>(mesh, std::move(models), std::move(known));
}

}  // namespace delam
