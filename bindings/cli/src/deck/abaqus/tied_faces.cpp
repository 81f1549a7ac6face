// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/tied_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace cli::abaqus {

namespace {

using Face = std::array<std::int64_t, 9>;
using Point = std::array<double, 3>;

// Part of a face by which a point beside it still lies on it: rounding of coordinates, and meshes of one curved surface
// whose edges differ. Half and twice find the same faces of meshes that end together (ctest -R cli_deck_keywords).
constexpr double beside = 1e-3;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A face by its corners, in the plane by its two ends.
struct Patch {
    Face face{};
    std::vector<Point> corners;
    Point middle{};
    double size = 0;  // the largest distance of a corner from the middle
};

Patch patch_of(const MeshData& mesh, const Face& face) {
    Patch out;
    out.face = face;
    const auto nodes = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
    const std::size_t corners = mesh.dimension == 2 ? 2 : nodes % 3 == 0 && nodes != 9 ? 3 : 4;
    for (std::size_t k = 0; k < std::min(corners, nodes); ++k) {
        Point at{};
        std::copy_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(face[k] * mesh.dimension), mesh.dimension,
                    at.begin());
        for (std::size_t a = 0; a < 3; ++a) out.middle[a] += at[a] / static_cast<double>(corners);
        out.corners.push_back(at);
    }
    for (const Point& corner : out.corners)
        out.size = std::max(out.size, std::sqrt(dot(corner - out.middle, corner - out.middle)));
    return out;
}

constexpr double off = std::numeric_limits<double>::infinity();

double beyond_segment(const Point& a, const Point& b, const Point& x) {
    const Point along = b - a;
    const double share = dot(x - a, along) / dot(along, along);
    if (!(share > -beside && share < 1 + beside)) return off;
    const Point foot{a[0] + share * along[0], a[1] + share * along[1], a[2] + share * along[2]};
    return std::sqrt(dot(x - foot, x - foot));
}

double beyond_triangle(const Point& a, const Point& b, const Point& c, const Point& x) {
    const Point normal = cross(b - a, c - a);
    const double square = dot(normal, normal);
    if (!(square > 0)) return off;
    const double u = dot(cross(c - b, x - b), normal) / square, v = dot(cross(a - c, x - c), normal) / square;
    const double w = 1 - u - v;
    if (!(std::min({u, v, w}) > -beside)) return off;
    return std::abs(dot(x - a, normal)) / std::sqrt(square);
}

// The distance of a point from the face onto which it is projected; infinite where it lies beside it.
double distance(const Patch& on, const Point& x) {
    const std::vector<Point>& c = on.corners;
    if (c.size() == 2) return beyond_segment(c[0], c[1], x);
    double out = off;
    for (std::size_t k = 2; k < c.size(); ++k) out = std::min(out, beyond_triangle(c[0], c[k - 1], c[k], x));
    return out;
}

// Finds the nearest of many faces below or above a point.
class Patches {
public:
    explicit Patches(std::vector<Patch> all) : all_(std::move(all)) {
        std::sort(all_.begin(), all_.end(), [](const Patch& a, const Patch& b) { return a.middle[0] < b.middle[0]; });
        for (const Patch& patch : all_) reach_ = std::max(reach_, patch.size);
    }

    [[nodiscard]] const std::vector<Patch>& all() const { return all_; }

    // Its position and distance; infinite: there is none.
    [[nodiscard]] std::pair<std::size_t, double> nearest(const Point& x) const {
        // A face whose middle is farther along x than its size and the distance sought cannot be meant.
        std::pair<std::size_t, double> out{0, off};
        const double reach = 2 * reach_;
        auto at = std::lower_bound(all_.begin(), all_.end(), x[0] - reach,
                                   [](const Patch& patch, double value) { return patch.middle[0] < value; });
        for (; at != all_.end() && at->middle[0] <= x[0] + reach; ++at)
            if (const double found = distance(*at, x); found < out.second)
                out = {static_cast<std::size_t>(at - all_.begin()), found};
        return out;
    }

private:
    std::vector<Patch> all_;
    double reach_ = 0;
};

Patches patches_of(const MeshData& mesh, const std::string& surface) {
    std::vector<Patch> out;
    std::set<Face> met;
    for (const Face& face : mesh.face_sets.at(surface))
        if (met.insert(face).second) out.push_back(patch_of(mesh, face));
    return Patches(std::move(out));
}

// A tie, and the faces of cohesive elements that belong to it.
struct Joint {
    const TiedNodes* tie;
    Patches bodies;
    std::vector<Patch> own{};

    [[nodiscard]] bool holds(const Face& face) const {
        return std::all_of(face.begin(), face.end(),
                           [&](std::int64_t node) { return node < 0 || tie->nodes.contains(node); });
    }
};

}  // namespace

void tie_to_bodies(const MeshData& mesh, const std::vector<TiedNodes>& ties, const LooseElements& loose,
                   CohesiveSet& set, std::vector<Face>& faces) {
    std::vector<bool> of_cell(mesh.nodes.size() / static_cast<std::size_t>(mesh.dimension), false);
    for (const CellBlock& block : mesh.blocks)
        for (const std::int64_t node : block.connectivity) of_cell[static_cast<std::size_t>(node)] = true;
    std::vector<Joint> joints;
    for (const TiedNodes& tie : ties) joints.push_back({&tie, patches_of(mesh, tie.surface)});
    set.apart.assign(set.lower.size(), -1);
    for (const auto& [element, place] : loose) {
        const Patch low = patch_of(mesh, set.lower[element]), high = patch_of(mesh, set.upper[element]);
        const Point across = high.middle - low.middle;
        set.apart[element] = std::sqrt(dot(across, across));
        for (const bool upper : {false, true}) {
            const Patch& own = upper ? high : low;
            if (of_cell[static_cast<std::size_t>(own.face[0])]) {
                faces.push_back(own.face);
                continue;
            }
            const auto joint =
                std::find_if(joints.begin(), joints.end(), [&](const Joint& each) { return each.holds(own.face); });
            const auto found =
                joint == joints.end() ? std::pair<std::size_t, double>{0, off} : joint->bodies.nearest(own.middle);
            if (!(found.second < 2 * own.size))
                throw SceneFailure(
                    place, fmt::format("a cohesive element of \"{}\" has nodes of its own, and its {} face {}",
                                       set.name, upper ? "upper" : "lower",
                                       joint == joints.end() ? "is in no surface of a *TIE to sides of cells"
                                                             : "lies on no side of a cell to which it is tied"));
            set.apart[element] += found.second;
            (upper ? set.upper : set.lower)[element] = joint->bodies.all()[found.first].face;
            joint->own.push_back(own);
        }
    }
    for (Joint& joint : joints) {
        const Patches elements(std::move(joint.own));
        for (const Patch& body : joint.bodies.all())
            if (elements.nearest(body.middle).second < 2 * body.size) faces.push_back(body.face);
    }
}

}  // namespace cli::abaqus
