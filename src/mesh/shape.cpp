// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr ReferencePoint simplex_corner[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr ReferencePoint square_corner[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
constexpr ReferencePoint cube_corner[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
constexpr ReferencePoint prism_corner[] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
constexpr ReferencePoint pyramid_corner[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {0, 0, 1}};
constexpr ReferencePoint triangle_centre = {1.0 / 3.0, 1.0 / 3.0, 0};
constexpr ReferencePoint tetrahedron_centre = {0.25, 0.25, 0.25};
constexpr ReferencePoint cube_centre = {0, 0, 0};
constexpr ReferencePoint prism_centre = {1.0 / 3.0, 1.0 / 3.0, 0};
constexpr ReferencePoint pyramid_centre = {0, 0, -0.5};  // at a quarter of the height

const ReferencePoint* corners_of(const CellRow& row) {
    switch (row.reference) {
        case ReferenceCell::simplex:
            return simplex_corner;
        case ReferenceCell::prism:
            return prism_corner;
        case ReferenceCell::pyramid:
            return pyramid_corner;
        case ReferenceCell::box:
            break;
    }
    return row.topology.dimension == 2 ? square_corner : cube_corner;
}

// True for the node that a whole face of the reference cell is mapped to.
bool is_apex(const CellRow& row, std::size_t node) { return row.reference == ReferenceCell::pyramid && node == 4; }

std::vector<ReferencePoint> node_list(const CellRow& row) {
    const CellTopology& shape = row.topology;
    const ReferencePoint* corner = corners_of(row);
    std::vector<ReferencePoint> nodes(corner, corner + shape.corners);
    for (std::size_t k = 0; nodes.size() < index(shape.nodes); ++k) {
        const ReferencePoint& p = corner[shape.middle[k][0]];
        const ReferencePoint& q = corner[shape.middle[k][1]];
        nodes.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])});
    }
    return nodes;
}

constexpr double sixth = 1.0 / 6.0;
// Rules on the triangle, as points with their weights: of degree 2, and of degree 4 (G. Cowper, Int. J. Numer. Meth.
// Eng. 7, 1973: two orbits of three points).
using TriangleRule = std::vector<std::pair<ReferencePoint, double>>;
TriangleRule triangle_3() {
    return {{{sixth, sixth, 0}, sixth}, {{4 * sixth, sixth, 0}, sixth}, {{sixth, 4 * sixth, 0}, sixth}};
}
TriangleRule triangle_6() {
    TriangleRule rule;
    const double root = std::sqrt(10.0);
    for (const double sign : {1.0, -1.0}) {
        const double at = (8.0 - root + sign * std::sqrt(38.0 - 44.0 * std::sqrt(0.4))) / 18.0;
        const double weight = (620.0 + sign * std::sqrt(213125.0 - 53320.0 * root)) / 7440.0;
        for (const ReferencePoint& p :
             {ReferencePoint{at, at, 0}, ReferencePoint{1.0 - 2.0 * at, at, 0}, ReferencePoint{at, 1.0 - 2.0 * at, 0}})
            rule.emplace_back(p, weight);
    }
    return rule;
}

// Products of the rules of Gauss on [-1,1] with 2 points (exact to degree 3 in each direction) or 3 (degree 5).
Quadrature gauss_product(int dimension, int order) {
    const double two = 1.0 / std::sqrt(3.0);
    const double three = std::sqrt(0.6);
    const std::vector<double> x = order == 2 ? std::vector{-two, two} : std::vector{-three, 0.0, three};
    const std::vector<double> w = order == 2 ? std::vector{1.0, 1.0} : std::vector{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    Quadrature rule;
    for (std::size_t k = 0; k < (dimension == 3 ? x.size() : 1); ++k)
        for (std::size_t j = 0; j < (dimension == 1 ? 1 : x.size()); ++j)
            for (std::size_t i = 0; i < x.size(); ++i) {
                rule.points.push_back({x[i], dimension == 1 ? 0.0 : x[j], dimension == 3 ? x[k] : 0.0});
                rule.weights.push_back(w[i] * (dimension == 1 ? 1.0 : w[j]) * (dimension == 3 ? w[k] : 1.0));
            }
    return rule;
}

Quadrature prism_product(const TriangleRule& triangle, int order) {
    const Quadrature line = gauss_product(1, order);
    Quadrature rule;
    for (std::size_t k = 0; k < line.points.size(); ++k)
        for (const auto& [p, weight] : triangle) {
            rule.points.push_back({p[0], p[1], line.points[k][0]});
            rule.weights.push_back(weight * line.weights[k]);
        }
    return rule;
}

// Degrees that a rule must integrate: the products of gradients and, for constant stress, the gradients times the
// cofactors of dx/dxi. On tri6 both have degree 2: three points. On tet10 they have degrees 2 and 3; the vertices (1/40
// of the volume each) and the centroids of the faces (9/40 each) are exact to degree 3 (Keast, Comput. Meth. Appl.
// Mech. Eng. 55, 1986, lists such rules), while the familiar four points would violate equilibrium on curved cells. On
// quad8, quad9 and hex20 the degree in one variable is up to 4 and 5: three points in each direction; two would also
// leave motions without energy. On wedges the degrees over the triangle and along the axis are 2 and 2 (linear), 4 and
// 5. Within a pyramid, strains are the same along each ray from the apex, so that the degree along the axis is that of
// the area, 2, and in the other two directions at most 2.
Quadrature rule_of(const CellRow& row) {
    const int dimension = row.topology.dimension;
    const double s = sixth;
    const double t = 1.0 / 3.0;
    switch (row.rule) {
        case Rule::centroid:
            if (dimension == 2) return {{triangle_centre}, {0.5}, {}};
            return {{tetrahedron_centre}, {s}, {}};
        case Rule::triangle3:
            return {{{s, s, 0}, {4 * s, s, 0}, {s, 4 * s, 0}}, {s, s, s}, {}};
        case Rule::tetrahedron8: {
            const double vertex = s / 40.0;
            const double face = 9.0 * s / 40.0;
            return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {t, t, t}, {0, t, t}, {t, 0, t}, {t, t, 0}},
                    {vertex, vertex, vertex, vertex, face, face, face, face},
                    {}};
        }
        case Rule::gauss2:
            return gauss_product(dimension, 2);
        case Rule::gauss3:
            return gauss_product(dimension, 3);
        case Rule::prism6:
            return prism_product(triangle_3(), 2);
        case Rule::prism18:
            return prism_product(triangle_6(), 3);
    }
    fail(DELAM_ERROR_INTERNAL, "cell type ", row.topology.name, " has no quadrature rule");
}

// Data of a type that do not depend on a cell, computed once.
struct Reference {
    std::vector<ReferencePoint> nodes;
    Quadrature rule;
    std::vector<ShapeGradient> checked;  // gradients at the quadrature points and nodes
    ShapeGradient at_centre;
};

const Reference& reference(CellType type) {
    static const std::vector<Reference> list = [] {
        std::vector<Reference> made;
        for (const CellRow& row : cell_rows) {
            Reference r{node_list(row), rule_of(row), {}, reference_gradient(row.type, centre(row.type))};
            for (const ReferencePoint& p : r.rule.points) r.rule.gradients.push_back(reference_gradient(row.type, p));
            r.checked = r.rule.gradients;
            for (std::size_t a = 0; !row.one_strain() && a < r.nodes.size(); ++a)
                if (!is_apex(row, a)) r.checked.push_back(reference_gradient(row.type, r.nodes[a]));
            made.push_back(std::move(r));
        }
        return made;
    }();
    return list[index(&cell_row(type) - cell_rows.data())];
}

// A shape function with its gradient.
struct Shape {
    double value;
    ReferencePoint gradient;
};

// Barycentric coordinates L of a simplex: linear N_a = L_a; quadratic N_a = L_a (2 L_a - 1) at corners and
// 4 L_a L_b midway between a and b.
Shape simplex_shape(const CellTopology& cell, std::size_t node, const ReferencePoint& at) {
    const auto barycentric = [&](std::size_t a) -> Shape {
        if (a == 0) return {1.0 - at[0] - at[1] - (cell.dimension == 3 ? at[2] : 0.0), {-1, -1, -1}};
        Shape l{at[a - 1], {}};
        l.gradient[a - 1] = 1.0;
        return l;
    };
    const auto corners = index(cell.corners);
    if (node < corners) {
        Shape l = barycentric(node);
        if (cell.nodes == cell.corners) return l;
        for (double& g : l.gradient) g *= 4.0 * l.value - 1.0;
        return {l.value * (2.0 * l.value - 1.0), l.gradient};
    }
    const auto& [a, b] = cell.middle[node - corners];
    const Shape p = barycentric(index(a));
    const Shape q = barycentric(index(b));
    Shape n{4.0 * p.value * q.value, {}};
    for (std::size_t i = 0; i < 3; ++i) n.gradient[i] = 4.0 * (p.gradient[i] * q.value + p.value * q.gradient[i]);
    return n;
}

// Product of a factor for each direction; the serendipity corners carry one more factor (sum_i xi_i c_i - d + 1).
Shape box_shape(const CellRow& row, const ReferencePoint& c, const ReferencePoint& at) {
    const auto dim = index(row.topology.dimension);
    const bool lagrange = row.interpolation == Interpolation::quadratic;
    const double share = dim == 2 ? 0.25 : 0.125;
    std::array<double, 3> f{1, 1, 1};
    std::array<double, 3> df{0, 0, 0};
    double scale = 1.0;
    bool corner = true;
    for (std::size_t i = 0; i < dim; ++i) {
        const bool middle = c[i] == 0.0;
        corner = corner && !middle;
        if (lagrange) {  // Lagrange polynomials in each direction
            f[i] = middle ? 1.0 - at[i] * at[i] : 0.5 * at[i] * (at[i] + c[i]);
            df[i] = middle ? -2.0 * at[i] : at[i] + 0.5 * c[i];
        } else {
            f[i] = middle ? 1.0 - at[i] * at[i] : 1.0 + c[i] * at[i];
            df[i] = middle ? -2.0 * at[i] : c[i];
        }
    }
    if (!lagrange) scale = corner ? share : 2.0 * share;
    Shape n{scale * f[0] * f[1] * f[2],
            {scale * df[0] * f[1] * f[2], scale * f[0] * df[1] * f[2], scale * f[0] * f[1] * df[2]}};
    if (corner && row.interpolation == Interpolation::serendipity) {
        double more = 1.0 - static_cast<double>(dim);
        for (std::size_t i = 0; i < dim; ++i) more += c[i] * at[i];
        for (std::size_t i = 0; i < dim; ++i) n.gradient[i] = n.gradient[i] * more + n.value * c[i];
        n.value *= more;
    }
    return n;
}

// Wedges: linear N_a = L_a (1 + z z_a)/2; of second degree L_a ((2 L_a - 1)(1 + z z_a) - (1 - z^2))/2 at corners, 2 L_a
// L_b (1 + z z_a) midway between two corners of a triangle and L_a (1 - z^2) midway between the triangles.
Shape prism_shape(const CellRow& row, std::size_t node, const ReferencePoint& at) {
    const double l[] = {1.0 - at[0] - at[1], at[0], at[1]};
    constexpr double slope[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    const double z = at[2], arch = 1.0 - z * z;
    const auto corners = index(row.topology.corners);
    const std::size_t a = node < corners ? node : index(row.topology.middle[node - corners][0]);
    const std::size_t b = node < corners ? node : index(row.topology.middle[node - corners][1]);
    const double up = a < 3 ? 1.0 : -1.0, side = 1.0 + up * z;
    const std::size_t p = a % 3, q = b % 3;
    double value = 0.5 * l[p] * side, by_p = 0.5 * side, by_q = 0.0, by_z = 0.5 * l[p] * up;
    if (node >= corners && p == q) {
        value = l[p] * arch, by_p = arch, by_z = -2.0 * z * l[p];
    } else if (node >= corners) {
        value = 2.0 * l[p] * l[q] * side, by_p = 2.0 * l[q] * side, by_q = 2.0 * l[p] * side;
        by_z = 2.0 * l[p] * l[q] * up;
    } else if (!row.linear()) {
        value = 0.5 * l[p] * ((2.0 * l[p] - 1.0) * side - arch);
        by_p = 0.5 * ((4.0 * l[p] - 1.0) * side - arch);
        by_z = 0.5 * l[p] * ((2.0 * l[p] - 1.0) * up + 2.0 * z);
    }
    return {value, {by_p * slope[p][0] + by_q * slope[q][0], by_p * slope[p][1] + by_q * slope[q][1], by_z}};
}

// The base of a pyramid has the functions of the lower face of a cube: these are, in the coordinates of the pyramid
// itself, rational functions that are linear on its triangles (G. Bedrosian, Int. J. Numer. Meth. Eng. 35, 1992).
Shape shape(const CellRow& row, std::size_t node, const ReferencePoint& at) {
    const CellTopology& cell = row.topology;
    if (row.simplex()) return simplex_shape(cell, node, at);
    if (row.reference == ReferenceCell::prism) return prism_shape(row, node, at);
    if (is_apex(row, node)) return {0.5 * (1.0 + at[2]), {0, 0, 0.5}};
    const auto corners = index(cell.corners);
    const ReferencePoint* corner = corners_of(row);
    if (node < corners) return box_shape(row, corner[node], at);
    ReferencePoint c;
    for (std::size_t i = 0; i < 3; ++i)
        c[i] = 0.5 * (corner[cell.middle[node - corners][0]][i] + corner[cell.middle[node - corners][1]][i]);
    return box_shape(row, c, at);
}

using Matrix3 = std::array<double, 9>;  // row-major, the leading dimension x dimension block in use, stride 3

// dx_i/dxi_j = sum_a (x_ai - x_0i) dN_a/dxi_j. Coordinates are taken relative to the first node: the sums then do not
// cancel for a cell far from the origin.
template <std::size_t dim>
Matrix3 tangent(std::size_t nodes, const double* x, const ShapeGradient& gradient) {
    Matrix3 j{};
    for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t r = 0; r < dim; ++r) {
            const double local = x[a * dim + r] - x[r];
            for (std::size_t c = 0; c < dim; ++c) j[3 * r + c] += local * gradient[a * dim + c];
        }
    return j;
}

Matrix3 tangent(const CellTopology& cell, std::span<const double> coordinates, const ShapeGradient& gradient) {
    const std::size_t nodes = index(cell.nodes);
    return cell.dimension == 2 ? tangent<2>(nodes, coordinates.data(), gradient)
                               : tangent<3>(nodes, coordinates.data(), gradient);
}

double determinant(int dimension, const Matrix3& j) {
    if (dimension == 2) return j[0] * j[4] - j[1] * j[3];
    return j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) + j[2] * (j[3] * j[7] - j[4] * j[6]);
}

Matrix3 inverse(int dimension, const Matrix3& j, double det) {
    if (dimension == 2) return {j[4] / det, -j[1] / det, 0, -j[3] / det, j[0] / det, 0, 0, 0, 0};
    return {(j[4] * j[8] - j[5] * j[7]) / det, (j[2] * j[7] - j[1] * j[8]) / det, (j[1] * j[5] - j[2] * j[4]) / det,
            (j[5] * j[6] - j[3] * j[8]) / det, (j[0] * j[8] - j[2] * j[6]) / det, (j[2] * j[3] - j[0] * j[5]) / det,
            (j[3] * j[7] - j[4] * j[6]) / det, (j[1] * j[6] - j[0] * j[7]) / det, (j[0] * j[4] - j[1] * j[3]) / det};
}

// dN/dx = (dN/dxi) J^-1.
template <std::size_t dim>
void push_forward(std::size_t nodes, const ShapeGradient& on_reference, const Matrix3& inverse, double* gradient) {
    for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t c = 0; c < dim; ++c) {
            double sum = 0.0;
            for (std::size_t r = 0; r < dim; ++r) sum += on_reference[a * dim + r] * inverse[3 * r + c];
            gradient[a * dim + c] = sum;
        }
}

}  // namespace

const ShapeGradient& centre_gradient(CellType type) { return reference(type).at_centre; }

const Quadrature& quadrature(CellType type) { return reference(type).rule; }

std::span<const ReferencePoint> reference_nodes(CellType type) { return reference(type).nodes; }

const ReferencePoint& centre(CellType type) {
    const CellRow& row = cell_row(type);
    if (row.reference == ReferenceCell::box) return cube_centre;
    if (row.reference == ReferenceCell::prism) return prism_centre;
    if (row.reference == ReferenceCell::pyramid) return pyramid_centre;
    return row.topology.dimension == 2 ? triangle_centre : tetrahedron_centre;
}

ShapeValues shape_values(CellType type, const ReferencePoint& at) {
    ShapeValues n{};
    const CellRow& row = cell_row(type);
    for (std::size_t a = 0; a < index(row.topology.nodes); ++a) n[a] = shape(row, a, at).value;
    return n;
}

ShapeGradient reference_gradient(CellType type, const ReferencePoint& at) {
    const CellRow& row = cell_row(type);
    const auto dim = index(row.topology.dimension);
    ShapeGradient g{};
    for (std::size_t a = 0; a < index(row.topology.nodes); ++a)
        std::copy_n(shape(row, a, at).gradient.begin(), dim, g.begin() + static_cast<std::ptrdiff_t>(a * dim));
    return g;
}

PhysicalGradient physical_gradient(CellType type, std::span<const double> coordinates,
                                   const ShapeGradient& on_reference) {
    const CellTopology& cell = topology(type);
    const Matrix3 j = tangent(cell, coordinates, on_reference);
    PhysicalGradient result;
    result.jacobian = determinant(cell.dimension, j);
    const Matrix3 inv = inverse(cell.dimension, j, result.jacobian);
    if (cell.dimension == 2)
        push_forward<2>(index(cell.nodes), on_reference, inv, result.gradient.data());
    else
        push_forward<3>(index(cell.nodes), on_reference, inv, result.gradient.data());
    return result;
}

double jacobian(CellType type, std::span<const double> coordinates, const ShapeGradient& on_reference) {
    const CellTopology& cell = topology(type);
    return determinant(cell.dimension, tangent(cell, coordinates, on_reference));
}

double smallest_jacobian(CellType type, std::span<const double> coordinates) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const ShapeGradient& gradient : reference(type).checked)
        smallest = std::min(smallest, jacobian(type, coordinates, gradient));
    return smallest;
}

}  // namespace delam
