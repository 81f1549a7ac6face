// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/orientations.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace cli::abaqus {

namespace {

Vector normal_to(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector unit(const Vector& v, const Place& place) {
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(length > 0)) throw SceneFailure(place, "the points lie on one line: they give no axes");
    return {v[0] / length, v[1] / length, v[2] / length};
}

Vector difference(const std::vector<double>& points, std::size_t to, std::size_t from) {
    return {points[to] - points[from], points[to + 1] - points[from + 1], points[to + 2] - points[from + 2]};
}

// Axis 1 points away from the axis of the cylinder, axis 3 along it.
Axes cylindrical_axes(const std::vector<double>& points, const Vector& centre, const Place& place) {
    const Vector along = difference(points, 3, 0);
    if (along == Vector{}) throw SceneFailure(place, "the two points of the axis are the same");
    Axes axes;
    axes[2] = unit(along, place);
    const Vector to{centre[0] - points[0], centre[1] - points[1], centre[2] - points[2]};
    const double height = inner(to, axes[2]);
    Vector out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = to[k] - height * axes[2][k];
    if (!(std::hypot(out[0], out[1], out[2]) > 1e-9 * std::hypot(along[0], along[1], along[2])))
        throw SceneFailure(place, "the centre of the element lies on the axis: it has no radial direction");
    axes[0] = unit(out, place);
    axes[1] = normal_to(axes[2], axes[0]);
    return axes;
}

bool is_name(const std::string& field) {
    return !field.empty() && (std::isalpha(static_cast<unsigned char>(field[0])) != 0 || field[0] == '_');
}

}  // namespace

void turn(Axes& axes, int about, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    const auto i = static_cast<std::size_t>(about % 3);
    const auto j = static_cast<std::size_t>((about + 1) % 3);
    const Vector a = axes[i], b = axes[j];
    for (std::size_t k = 0; k < 3; ++k) {
        axes[i][k] = c * a[k] + s * b[k];
        axes[j][k] = c * b[k] - s * a[k];
    }
}

std::array<double, 6> first_two(const Axes& axes) {
    std::array<double, 6> out{};
    for (std::size_t i = 0; i < 6; ++i) {
        const double x = axes[i / 3][i % 3];
        out[i] = std::abs(x) < 1e-15 ? 0.0 : x;
    }
    return out;
}

Axes Orientation::axes(const std::vector<double>& of_element, const Vector& centre, const Place& at) const {
    Axes out;
    if (cylindrical) {
        out = cylindrical_axes(of_element, centre, at);
    } else {
        out[0] = unit(difference(of_element, 0, 6), at);
        out[2] = unit(normal_to(out[0], difference(of_element, 3, 6)), at);
        out[1] = normal_to(out[2], out[0]);
    }
    turn(out, about == 0 ? 1 : about, angle);
    return out;
}

Vector NodeSystem::global(const Vector& at) const {
    Vector out = origin;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) out[k] += at[i] * axes[i][k];
    return out;
}

// Origin and a point of axis 1, then a point on the side of axis 2; without the latter axis 3 stays z.
std::optional<NodeSystem> node_system_of(const InpCard& card) {
    card.check();
    if (card.lines.empty()) return std::nullopt;
    if (card.lines.size() > 2) throw SceneFailure(card.lines[2].place, "at most two lines are expected");
    std::vector<double> points = card.lines[0].numbers();
    if (points.size() > 6)
        throw SceneFailure(card.lines[0].place, fmt::format("{} coordinates: 3 of the origin, and 3 of a point of the "
                                                            "axis of x, are expected",
                                                            points.size()));
    const bool turned = points.size() > 3;
    points.resize(turned ? 6 : 3, 0.0);
    NodeSystem out;
    out.origin = {points[0], points[1], points[2]};
    if (!turned) {
        if (card.lines.size() > 1)
            throw SceneFailure(card.lines[1].place, "a point of the axis of x is expected in the first line");
        return out;
    }
    Vector along = difference(points, 3, 0);
    if (card.lines.size() == 1) along[2] = 0;
    if (along == Vector{}) throw SceneFailure(card.lines[0].place, "the points of the axis of x are the same");
    out.axes[0] = unit(along, card.lines[0].place);
    if (card.lines.size() > 1) {
        std::vector<double> third = card.lines[1].numbers();
        if (third.size() > 3)
            throw SceneFailure(card.lines[1].place, fmt::format("{} coordinates: 3 are expected", third.size()));
        third.resize(3, 0.0);
        const Vector to{third[0] - points[0], third[1] - points[1], third[2] - points[2]};
        const Vector across = normal_to(out.axes[0], to);
        if (!(std::hypot(across[0], across[1], across[2]) > 1e-9 * std::hypot(to[0], to[1], to[2])))
            throw SceneFailure(card.lines[1].place, "this point lies on the axis of x: it gives no axis of y");
        out.axes[2] = unit(across, card.lines[1].place);
    }
    out.axes[1] = normal_to(out.axes[2], out.axes[0]);
    return out;
}

Orientation orientation_of(const InpCard& card) {
    card.check();
    Orientation out;
    out.name = card.required("NAME");
    out.place = card.place;
    out.cylindrical = card.parameter("SYSTEM") == "CYLINDRICAL";
    const InpLine& first = card.first_line();
    if (!first.fields.empty() && is_name(first.fields[0])) {
        out.distribution = first.fields[0];
        if (std::any_of(first.fields.begin() + 1, first.fields.end(), [](const auto& field) { return !field.empty(); }))
            throw SceneFailure(first.place, "the name of a *DISTRIBUTION is expected alone");
    } else {
        out.points = first.numbers();
        if (out.points.size() != 6 && (out.cylindrical || out.points.size() != 9))
            throw SceneFailure(first.place, out.cylindrical
                                                ? "6 coordinates, two points of the axis, or the name of a "
                                                  "*DISTRIBUTION are expected"
                                                : "6 or 9 coordinates or the name of a *DISTRIBUTION are expected");
        out.points.resize(9, 0.0);
    }
    if (card.lines.size() > 1) {
        const InpLine& second = card.lines[1];
        if (second.fields.size() > 1 && is_name(second.fields[1]))
            throw SceneFailure(second.place, "\"" + second.fields[1] +
                                                 "\": an angle is expected; that of each element is imported within "
                                                 "the axes of the *DISTRIBUTION of the first line");
        const std::vector<double> by = second.numbers();
        if (by.empty() || by.size() > 2 || (by[0] != 1 && by[0] != 2 && by[0] != 3))
            throw SceneFailure(second.place, "an axis, 1 to 3, and an angle are expected");
        out.about = static_cast<int>(by[0]);
        if (by.size() == 2) out.angle = by[1];
    }
    return out;
}

bool Laminate::turns() const {
    return std::any_of(plies.angles.begin(), plies.angles.end(), [](double angle) { return angle != 0; });
}

Laminate laminate_of(const InpCard& section) {
    if (section.has("STACK DIRECTION") && section.required("STACK DIRECTION") != "3")
        section.refuse("STACK DIRECTION", section.required("STACK DIRECTION"), "3");
    Laminate out;
    out.plies.place = section.place;
    out.plies.name = section.parameter("ELSET");
    (void)section.first_line();
    for (const InpLine& line : section.lines) {
        if (line.fields.size() < 3) throw SceneFailure(line.place, "thickness, points, material are expected");
        if (out.material.empty()) out.material = line.fields[2];
        if (upper(line.fields[2]) != upper(out.material))
            throw SceneFailure(line.place,
                               fmt::format("plies of \"{}\" and of \"{}\" in one cell are not imported: give "
                                           "the plies elements of their own, and each material its section",
                                           out.material, line.fields[2]));
        out.plies.thicknesses.push_back(line.fields[0].empty() ? 0 : inp_number(line.fields[0], line.place));
        const bool angle = line.fields.size() > 3 && !line.fields[3].empty();
        if (angle && is_name(line.fields[3]))
            throw SceneFailure(line.place, "\"" + line.fields[3] +
                                               "\": the angle of a ply within the ORIENTATION= of the section is "
                                               "expected");
        out.plies.angles.push_back(angle ? inp_number(line.fields[3], line.place) : 0);
    }
    // The plies up to the middle one, which is there twice.
    if (section.has("SYMMETRIC"))
        for (auto* each : {&out.plies.thicknesses, &out.plies.angles}) {
            const std::vector<double> half = *each;
            each->insert(each->end(), half.rbegin(), half.rend());
        }
    if (out.plies.thicknesses.size() == 1) return out;
    for (std::size_t i = 0; i < section.lines.size(); ++i)
        if (!(out.plies.thicknesses[i] > 0))
            throw SceneFailure(section.lines[i].place,
                               fmt::format("thickness {}: must be > 0", out.plies.thicknesses[i]));
    if (out.turns() && !section.has("ORIENTATION"))
        throw SceneFailure(section.place,
                           "the angles of plies need the ORIENTATION= of the section, whose second line is 3, ..: axis "
                           "3 is the normal of the plies");
    return out;
}

}  // namespace cli::abaqus
