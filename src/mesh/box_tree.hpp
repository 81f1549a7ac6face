// SPDX-License-Identifier: BSD-3-Clause
// Search among many boxes (or points) in space: a binary tree over them, halved at the median of the longest extent.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace delam {

using Point = std::array<double, 3>;

struct Box {
    Point low{};
    Point high{};
};

// Returns how far a point is from a box; 0 within.
double distance(const Box& box, const Point& p);

class BoxTree {
public:
    explicit BoxTree(std::vector<Box> boxes);

    // Calls visit(i) for each box that contains the point.
    void containing(const Point& point, const std::function<void(std::int64_t)>& visit) const;

    // Calls visit(i) for each box that has a point in common with this one.
    void meeting(const Box& box, const std::function<void(std::int64_t)>& visit) const;

    // The box nearest to a point (the first of several) among those within `limit`; index -1 if there is none.
    struct Nearest {
        std::int64_t index = -1;
        double distance = std::numeric_limits<double>::infinity();
    };
    Nearest nearest(const Point& point, double limit = std::numeric_limits<double>::infinity()) const;

private:
    struct Branch {
        Box box;
        std::int64_t begin;
        std::int64_t end;
        std::int64_t right;  // of the second child; the first one follows its parent; 0: a leaf
    };
    void grow(std::int64_t begin, std::int64_t end);

    std::vector<Box> boxes_;
    std::vector<std::int64_t> order_;
    std::vector<Branch> branches_;
};

}  // namespace delam
