// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/free_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/element.hpp"
#include "scene/carriers.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

// Points hold a part if they lie farther apart than this part of its size; fewer are left to the exact test. (Measured
// by verify/bench/constants.py on 60 random scenes: half and twice decide alike.)
constexpr double apart = 1e-3;
// A displacement below this part of the largest one of a motion is none. (Measured by verify/bench/constants.py on 250
// random scenes, of both: from a hundredth to a hundred times all decide alike.)
constexpr double still = 1e-6;

// Points at which two places hold each other in all directions: one, two, and in space three that span a plane.
struct Hold {
    std::array<std::array<double, 3>, 2> point{};
    int count = 0;

    // Takes in a point; true: the two places move as one.
    bool add(std::span<const double> x, double size) {
        std::array<double, 3> at{};
        std::copy(x.begin(), x.end(), at.begin());
        const auto from = [&](std::size_t k) {
            std::array<double, 3> d{};
            for (std::size_t i = 0; i < 3; ++i) d[i] = at[i] - point[k][i];
            return d;
        };
        const auto length = [](const std::array<double, 3>& d) { return std::sqrt(dot(d, d)); };
        const double least = apart * size;
        if (count == 0 || (count == 1 && length(from(0)) > least)) {
            if (count == 1 && x.size() == 2) return true;
            point[index(count++)] = at;
            return false;
        }
        if (count < 2) return false;
        const std::array<double, 3> a = from(0), b = from(1);
        const std::array<double, 3> across{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                           a[0] * b[1] - a[1] * b[0]};
        return length(across) > least * least;
    }
};

class Components {
public:
    explicit Components(std::int64_t count) : root_(index(count)) { std::iota(root_.begin(), root_.end(), 0); }
    std::int64_t of(std::int64_t i) {
        while (root_[index(i)] != i) i = root_[index(i)] = root_[index(root_[index(i)])];
        return i;
    }
    void join(std::int64_t a, std::int64_t b) { root_[index(std::max(of(a), of(b)))] = std::min(of(a), of(b)); }

private:
    std::vector<std::int64_t> root_;
};

}  // namespace

FreeParts::FreeParts(const Problem& problem)
    : dimension_(problem.mesh->dimension()), motions_(problem), body_(rigid_pieces(problem).body) {
    const Mesh& mesh = *problem.mesh;
    for (std::int32_t b = 0; b < mesh.body_count(); ++b) label_.push_back(mesh.body_label(b));
    for (const Pattern& pattern : problem.patterns) patterns_.push_back(pattern.name);
    if (!any()) return;
    const Pieces& pieces = rigid_pieces(problem);
    const auto dim = index(dimension_);
    std::vector<std::int64_t> place(pieces.count(), 0);
    std::vector<double> share(index(mesh.node_count()), 0.0);
    size_.assign(1, 0.0);
    for (std::size_t p = 0; p < pieces.count(); ++p) {
        if (motions_.holds(p)) continue;
        place[p] = places_++;
        double size = 0.0;
        for (const std::int64_t node : pieces.nodes[p])
            for (std::size_t k = 0; k < dim; ++k)
                size = std::max(size, std::abs(mesh.node(node)[k] - mesh.node(pieces.nodes[p].front())[k]));
        size_.push_back(size);
        // The nodes of a body without cells count alike.
        if (mesh.host_body(pieces.body[p]))
            for (const std::int64_t node : pieces.nodes[p]) share[index(node)] += 1.0;
    }
    std::vector<double> coordinates, gradients;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const std::span<const std::int64_t> cell = mesh.cell(c);
        const std::int64_t piece = pieces.of_node[index(cell.front())];
        if (piece < 0 || place[index(piece)] == 0) continue;
        coordinates.clear();
        for (const std::int64_t node : cell)
            coordinates.insert(coordinates.end(), mesh.node(node).begin(), mesh.node(node).end());
        gradients.assign(coordinates.size(), 0.0);
        const double volume = integrate_gradients(mesh.cell_type(c), coordinates, gradients);
        for (const std::int64_t node : cell) share[index(node)] += volume / static_cast<double>(cell.size());
    }
    for (std::size_t node = 0; node < share.size(); ++node)
        if (share[node] > 0.0) share_.emplace_back(static_cast<std::int64_t>(node), share[node]);

    const Carriers carriers(problem);
    const auto side = [&](std::int64_t node) -> std::int64_t {
        const auto of = carriers.of(node);
        std::int64_t found = -2;
        for (const auto& [carrier, weight] : of) {
            const std::int64_t piece = pieces.of_node[index(carrier)];
            const std::int64_t own = piece < 0 ? -1 : place[index(piece)];
            found = found == -2 || found == own ? own : -1;
        }
        return std::max<std::int64_t>(found, -1);
    };
    for (const InterfaceGeometry& face : mesh.interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p) {
            side_.emplace_back(side(face.node_a[p]), side(face.node_b[p]));
            const auto at = mesh.node(face.node_b[p]);
            place_.insert(place_.end(), at.begin(), at.end());
        }
}

bool FreeParts::connected(std::span<const std::uint8_t> active) const {
    const auto dim = index(dimension_);
    Components components(places_);
    std::map<std::pair<std::int64_t, std::int64_t>, Hold> holds;
    bool grounded = false;
    for (std::size_t p = 0; p < side_.size(); ++p) {
        const auto [a, b] = side_[p];
        grounded = grounded || a == 0 || b == 0;
        if (a < 0 || b < 0 || components.of(a) == components.of(b)) continue;
        const auto rows = active.subspan(p * dim, dim);
        if (std::any_of(rows.begin(), rows.end(), [](std::uint8_t on) { return on == 0; })) continue;
        const double size = std::max(size_[index(a)], size_[index(b)]);
        if (holds[std::minmax(a, b)].add(std::span<const double>(place_).subspan(p * dim, dim), size))
            components.join(a, b);
    }
    const std::int64_t first = grounded ? 0 : 1;
    for (std::int64_t place = first; place < places_; ++place)
        if (components.of(place) != components.of(first)) return false;
    return true;
}

DenseMatrix FreeParts::free(std::span<const std::uint8_t> active) const {
    if (!any() || connected(active)) return DenseMatrix(motions_.jumps().columns, 0);
    return split_motions(motions_.jumps(), active).free;
}

std::vector<std::uint8_t> FreeParts::moves(const DenseMatrix& free) const {
    const auto dim = index(dimension_);
    const std::size_t modes = dim == 2 ? 3 : 6;
    std::vector<std::uint8_t> moves(label_.size() * modes, 0);
    std::vector<DenseMatrix> motion(body_.size(), DenseMatrix(static_cast<std::int64_t>(modes), free.columns));
    double largest = 0.0;
    for (std::size_t p = 0; p < body_.size(); ++p)
        for (std::int64_t c = 0; c < free.columns; ++c) {
            const std::vector<double> own = motions_.of_piece(p, column(free, c));
            std::copy(own.begin(), own.end(), column(motion[p], c).begin());
            largest = std::max(largest, max_abs(own));
        }
    const auto mark = [&](std::size_t p, const DenseMatrix& own, std::size_t first, std::size_t last) {
        for (std::int64_t c = 0; c < own.columns; ++c)
            for (std::size_t m = first; m < last; ++m)
                if (std::abs(own(static_cast<std::int64_t>(m), c)) > still * largest)
                    moves[index(body_[p]) * modes + m] = 1;
    };
    for (std::size_t p = 0; p < body_.size(); ++p) {
        mark(p, motion[p], dim, modes);
        // Translations: the combinations of these motions without a rotation.
        DenseMatrix turning(free.columns, free.columns);
        for (std::size_t m = dim; m < modes; ++m)
            for (std::int64_t c = 0; c < free.columns; ++c)
                for (std::int64_t d = 0; d < free.columns; ++d)
                    turning(c, d) +=
                        motion[p](static_cast<std::int64_t>(m), c) * motion[p](static_cast<std::int64_t>(m), d);
        const Eigen eigen = eigen_symmetric(std::move(turning));
        DenseMatrix straight(free.columns, 0);
        for (std::int64_t c = 0; c < free.columns && std::sqrt(std::max(0.0, eigen.value[index(c)])) <= still * largest;
             ++c) {
            const auto vector = column(eigen.vector, c);
            straight.value.insert(straight.value.end(), vector.begin(), vector.end());
            ++straight.columns;
        }
        mark(p, multiply(motion[p], straight), 0, dim);
    }
    return moves;
}

std::string FreeParts::described(std::span<const std::uint8_t> moves) const {
    const std::size_t modes = dimension_ == 2 ? 3 : 6;
    std::vector<std::uint8_t> all(modes, 0);
    std::string bodies, ways;
    std::size_t count = 0;
    for (std::size_t b = 0; b < label_.size(); ++b) {
        const auto own = moves.subspan(b * modes, modes);
        if (std::all_of(own.begin(), own.end(), [](std::uint8_t m) { return m == 0; })) continue;
        bodies += text(count++ == 0 ? "" : ", ", label_[b]);
        for (std::size_t m = 0; m < modes; ++m) all[m] |= own[m];
    }
    const auto add = [&](const std::string& way) { ways += (ways.empty() ? "" : " and ") + way; };
    std::string axes;
    for (std::size_t k = 0; k < index(dimension_); ++k)
        if (all[k] != 0) axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[k]);
    if (!axes.empty()) add("move in " + axes);
    if (std::any_of(all.begin() + dimension_, all.end(), [](std::uint8_t m) { return m != 0; })) add("turn");
    return text(count == 1 ? "body " : "bodies ", bodies, " (free to ", ways, ")");
}

PlaceChanges FreeParts::changes(const DenseMatrix& free) const {
    PlaceChanges changes{{}, DenseMatrix(free.columns, free.columns)};
    for (std::int64_t c = 0; c < free.columns; ++c) {
        changes.moved.push_back(motions_.displacement(column(free, c)));
        for (std::int64_t d = 0; d <= c; ++d)
            changes.gram(c, d) = changes.gram(d, c) = product(changes.moved.back(), changes.moved[index(d)]);
    }
    return changes;
}

double FreeParts::product(std::span<const double> u, std::span<const double> v) const {
    double sum = 0.0;
    for (const auto& [node, share] : share_)
        for (std::int64_t k = 0; k < dimension_; ++k)
            sum += share * u[index(node * dimension_ + k)] * v[index(node * dimension_ + k)];
    return sum;
}

}  // namespace delam
