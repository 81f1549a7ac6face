// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/generate_weave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "mesh/gmsh/generator_model.hpp"
#include "mesh/gmsh/gmsh_session.hpp"
#include "mesh/gmsh/read_gmsh.hpp"
#include "mesh/periodic_mesh.hpp"
#include "mesh/quadratic_cells.hpp"

namespace cli {

namespace {

namespace occ = gmsh::model::occ;
using std::numbers::pi;

constexpr std::size_t yarns = 4;
// Sections through which a yarn's surface is interpolated; the error of the spline is 1e-5 spacings.
constexpr int sections = 16;

// Half the thickness of a yarn's section, t(d), over the distance d from the centre line; lengths in spacings.
class Section {
public:
    explicit Section(const WeaveCell& cell)
        : half_width_(cell.width / cell.spacing / 2),
          half_thickness_(cell.thickness / cell.spacing / 2),
          lens_(cell.section == "lens"),
          radius_((half_width_ * half_width_ + half_thickness_ * half_thickness_) / (2 * half_thickness_)) {}

    [[nodiscard]] double half_width() const { return half_width_; }
    [[nodiscard]] double half_thickness() const { return half_thickness_; }

    [[nodiscard]] double profile(double d) const {
        const double u = std::min(std::abs(d) / half_width_, 1.0);
        if (!lens_) return half_thickness_ * std::sqrt(1.0 - u * u);
        d = u * half_width_;
        return std::sqrt(radius_ * radius_ - d * d) - (radius_ - half_thickness_);
    }

    // The outline as two curves from tip to tip, in the plane x = 0 around the origin, (y, z) being (across, up).
    [[nodiscard]] std::vector<int> outline() const {
        std::vector<int> curves;
        gmsh::vectorpair all;
        for (const double side : {1.0, -1.0}) {
            int curve = 0;
            if (lens_) {
                const double angle = std::asin(half_width_ / radius_);
                const double middle = side * pi / 2;
                curve = occ::addCircle(0, side * (half_thickness_ - radius_), 0, radius_, -1, middle - angle,
                                       middle + angle);
            } else {
                curve = occ::addEllipse(0, 0, 0, half_width_, half_thickness_, -1, side > 0 ? 0 : pi,
                                        side > 0 ? pi : 2 * pi);
            }
            curves.push_back(curve);
            all.emplace_back(1, curve);
        }
        occ::rotate(all, 0, 0, 0, 1, 0, 0, pi / 2);
        occ::rotate(all, 0, 0, 0, 0, 0, 1, pi / 2);
        return curves;
    }

    // Projects onto the outline from nearby: radially for an ellipse, along z for a lens.
    void project(double& across, double& up) const {
        if (lens_) {
            up = up < 0 ? -profile(across) : profile(across);
            return;
        }
        const double length = std::hypot(across / half_width_, up / half_thickness_);
        across /= length;
        up /= length;
    }

private:
    double half_width_;
    double half_thickness_;
    bool lens_;
    double radius_;
};

// z = A sin(pi s), and the position and slope in the plane.
struct Yarn {
    bool warp;
    double across;     // of the centre line: y of a warp, x of a weft
    double amplitude;  // signed

    [[nodiscard]] double up(double along) const { return amplitude * std::sin(pi * along); }
    [[nodiscard]] double slope(double along) const { return amplitude * pi * std::cos(pi * along); }
};

// One yarn is up and the other down at every crossing.
std::array<Yarn, yarns> weave(double amplitude) {
    return {{{true, 0.5, amplitude}, {true, 1.5, -amplitude}, {false, 0.5, -amplitude}, {false, 1.5, amplitude}}};
}

constexpr std::array<const char*, yarns> yarn_names{"warp-1", "warp-2", "weft-1", "weft-2"};

// Crossing yarns are A (cos pi d + cos pi e) - t(d) - t(e) apart at the distances d and e from their centre lines. That
// is at least the gap if A cos pi d - t(d) is half of it for every d up to the half width.
double amplitude_of(const Section& section, double gap) {
    double amplitude = 0;
    constexpr int samples = 4000;
    for (int i = 0; i <= samples; ++i) {
        const double d = section.half_width() * i / samples;
        amplitude = std::max(amplitude, (gap / 2 + section.profile(d)) / std::cos(pi * d));
    }
    return amplitude;
}

std::vector<std::pair<int, int>> draw_yarn(const Section& section, const Yarn& yarn) {
    std::vector<int> wires;
    gmsh::vectorpair wire_parts;
    for (int i = 0; i <= sections; ++i) {
        const double along = 2.0 * i / sections;
        const double up = i == 0 || i == sections ? 0.0 : yarn.up(along);
        const std::vector<int> curves = section.outline();
        gmsh::vectorpair all;
        for (const int curve : curves) all.emplace_back(1, curve);
        if (!yarn.warp) occ::rotate(all, 0, 0, 0, 0, 0, 1, pi / 2);
        occ::translate(all, yarn.warp ? along : yarn.across, yarn.warp ? yarn.across : along, up);
        wires.push_back(occ::addWire(curves));
        wire_parts.insert(wire_parts.end(), all.begin(), all.end());
    }
    gmsh::vectorpair made;
    occ::addThruSections(wires, made, -1, true, false);
    occ::remove(wire_parts, true);
    gmsh::vectorpair volumes;
    for (const auto& part : made)
        if (part.first == 3) volumes.push_back(part);
    return volumes;
}

void draw(const Section& section, const std::array<Yarn, yarns>& all, double height, bool stacked) {
    gmsh::vectorpair tools;
    for (const Yarn& yarn : all) {
        const auto volumes = draw_yarn(section, yarn);
        if (volumes.size() != 1) throw std::string("a yarn is not one volume");
        tools.push_back(volumes.front());
    }
    if (stacked) occ::translate(tools, 0, 0, height / 2);
    const double bottom = stacked ? 0.0 : -height / 2;
    const gmsh::vectorpair block{{3, occ::addBox(0, 0, bottom, 2, 2, height)}};
    gmsh::vectorpair pieces;
    std::vector<gmsh::vectorpair> pieces_of;
    occ::fragment(block, tools, pieces, pieces_of);
    occ::synchronize();
    if (pieces.size() != yarns + 1)
        throw fmt::format("the yarns cut the cell into {} volumes instead of {}", pieces.size(), yarns + 1);

    const GeneratorModel model(3, {0, 0, bottom}, {2, 2, bottom + height});
    model.drop_loose_parts();
    std::vector<int> matrix;
    for (const auto& [dimension, tag] : pieces_of[0]) {
        bool of_yarn = false;
        for (std::size_t y = 0; y < yarns; ++y) of_yarn = of_yarn || pieces_of[y + 1].at(0).second == tag;
        if (!of_yarn) matrix.push_back(tag);
    }
    model.name_body(matrix, "matrix");
    for (std::size_t y = 0; y < yarns; ++y) model.name_body({pieces_of[y + 1].at(0).second}, yarn_names[y]);
    model.name_borders();
    model.tie_borders(0);
    model.tie_borders(1);
    if (stacked) model.tie_borders(2);
}

void mesh_volumes(double h) {
    gmsh::option::setNumber("Mesh.MeshSizeMax", h);
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0.25 * h);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.Optimize", 1);
    gmsh::model::mesh::generate(3);
}

// Axis 1 along the centre line, axis 2 in the plane of the fabric so that the third axis points up.
void orient(MeshData& mesh, const std::array<Yarn, yarns>& all) {
    for (const CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c) {
            const std::string& name = mesh.body_names[static_cast<std::size_t>(block.bodies[c])];
            const auto at = std::find(yarn_names.begin(), yarn_names.end(), name);
            if (at == yarn_names.end()) {
                mesh.orientation.push_back({1, 0, 0, 0, 1, 0});
                continue;
            }
            const Yarn& yarn = all[static_cast<std::size_t>(at - yarn_names.begin())];
            double along = 0;
            for (std::size_t i = 0; i < shape.corners; ++i)
                along += mesh.nodes[static_cast<std::size_t>(block.connectivity[c * shape.nodes + i]) * 3 +
                                    (yarn.warp ? 0 : 1)] /
                         static_cast<double>(shape.corners);
            const double slope = yarn.slope(along);
            const double length = std::hypot(1.0, slope);
            mesh.orientation.push_back(yarn.warp ? std::array<double, 6>{1 / length, 0, slope / length, 0, 1, 0}
                                                 : std::array<double, 6>{0, 1 / length, slope / length, -1, 0, 0});
        }
    }
}

// Moves middle nodes of sides between a yarn and matrix onto the yarn's surface, within their section.
std::int64_t bend_sides(MeshData& mesh, const Section& section, const std::array<Yarn, yarns>& all, double middle_z) {
    std::vector<const Yarn*> by_label;
    for (const std::string& name : mesh.body_names) {
        const auto at = std::find(yarn_names.begin(), yarn_names.end(), name);
        by_label.push_back(at == yarn_names.end() ? nullptr : &all[static_cast<std::size_t>(at - yarn_names.begin())]);
    }
    return make_quadratic(mesh, [&](const std::vector<std::int32_t>& bodies, double* middle) {
        const Yarn* yarn = nullptr;
        for (const std::int32_t body : bodies)
            if (by_label[static_cast<std::size_t>(body)] != nullptr) yarn = by_label[static_cast<std::size_t>(body)];
        if (yarn == nullptr) return;
        const double centre = yarn->up(middle[yarn->warp ? 0 : 1]) + middle_z;
        double across = middle[yarn->warp ? 1 : 0] - yarn->across;
        double up = middle[2] - centre;
        section.project(across, up);
        middle[yarn->warp ? 1 : 0] = yarn->across + across;
        middle[2] = centre + up;
    });
}

void check(const WeaveCell& cell) {
    const Place& place = cell.place;
    const auto positive = [&](double value, const char* key) {
        require(std::isfinite(value) && value > 0, place, key, fmt::format("must be > 0, got {}", value));
    };
    positive(cell.spacing, "spacing");
    positive(cell.width, "width");
    positive(cell.thickness, "thickness");
    positive(cell.gap, "gap");
    positive(cell.h, "h");
    require(cell.width <= 0.95 * cell.spacing, place, "width",
            fmt::format("must be in (0, {:.6g}], 0.95 spacing, got {}", 0.95 * cell.spacing, cell.width));
    require(cell.thickness <= cell.width, place, "thickness",
            fmt::format("must be in (0, {:.6g}], the width, got {}", cell.width, cell.thickness));
    require(cell.gap >= 0.02 * cell.thickness && cell.gap <= cell.spacing, place, "gap",
            fmt::format("must be in [{:.6g}, {:.6g}], 0.02 thickness to 1 spacing, got {}", 0.02 * cell.thickness,
                        cell.spacing, cell.gap));
    require(cell.h <= 0.5 * cell.spacing && cell.h >= 0.01 * cell.spacing, place, "h",
            fmt::format("must be in [{:.6g}, {:.6g}], 0.01 to 0.5 spacing, got {}", 0.01 * cell.spacing,
                        0.5 * cell.spacing, cell.h));
    require(cell.section == "ellipse" || cell.section == "lens", place, "section",
            fmt::format("must be ellipse or lens, got \"{}\"", cell.section));
    required_shape(cell.cell, weave_shapes(), place);
}

}  // namespace

double weave_amplitude(const WeaveCell& cell) {
    check(cell);
    return amplitude_of(Section(cell), cell.gap / cell.spacing) * cell.spacing;
}

MeshData generate_weave(const WeaveCell& cell) {
    check(cell);
    const Place& place = cell.place;
    const Section section(cell);
    const double unit = cell.spacing;
    const double gap = cell.gap / unit;
    const double amplitude = amplitude_of(section, gap);
    const double fabric = 2 * (amplitude + section.half_thickness());
    const double height = cell.height == 0 ? fabric + 2 * gap : cell.height / unit;
    require(height >= (fabric + gap) * (1 - 1e-12) && height <= 20, place, "height",
            fmt::format("must be in [{:.6g}, {:.6g}], the fabric (centre lines swing by {:.6g} either way) and a gap "
                        "to 20 spacings, or 0; got {}",
                        (fabric + gap) * unit, 20 * unit, amplitude * unit, cell.height));
    const std::array<Yarn, yarns> all = weave(amplitude);
    const double h = cell.h / unit;
    const double middle_z = cell.stacked ? height / 2 : 0.0;

    const std::string subject = fmt::format(
        "generator weave with h = {}, gap = {} (a smaller h or a larger gap helps where straight sides of "
        "cells cross the gap)",
        cell.h, cell.gap);
    MeshData mesh = with_gmsh(key_of(place, "h"), subject, [&] {
        draw(section, all, height, cell.stacked);
        mesh_volumes(h);
        MeshData read = read_gmsh_model(subject, place);
        std::vector<std::string> names{"matrix"};
        names.insert(names.end(), yarn_names.begin(), yarn_names.end());
        GeneratorModel::order_bodies(read, names);
        return read;
    });
    mesh.periods = {{2, 0, 0}, {0, 2, 0}};
    if (cell.stacked) mesh.periods.push_back({0, 0, height});
    align_borders(mesh, place);
    std::int64_t off_surface = 0;
    if (!shape_of(cell.cell).linear()) off_surface = bend_sides(mesh, section, all, middle_z);
    require_sound_cells(mesh, 1e-3, key_of(place, "h"));
    orient(mesh, all);

    for (double& x : mesh.nodes) x *= unit;
    for (auto& period : mesh.periods)
        for (double& p : period) p *= unit;
    const std::vector<double> volumes = GeneratorModel::measures(mesh);
    double total = 0;
    double in_yarns = 0;
    for (std::size_t b = 0; b < volumes.size(); ++b) {
        total += volumes[b];
        if (mesh.body_names[b] != "matrix") in_yarns += volumes[b];
    }
    mesh.notes.push_back(
        fmt::format("weave {:.6g} x {:.6g} x {:.6g}, yarns {:.4f} of its volume in this mesh, centre "
                    "lines swing by {:.6g} either way",
                    2 * unit, 2 * unit, height * unit, in_yarns / total, amplitude * unit));
    if (off_surface > 0)
        mesh.notes.push_back(
            fmt::format("{} sides of cells are off the yarns' surfaces: on them they would squeeze a "
                        "cell",
                        off_surface));
    return mesh;
}

}  // namespace cli
