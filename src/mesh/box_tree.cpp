// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr std::int64_t leaf_size = 8;

bool meet(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i)
        if (b.high[i] < a.low[i] || b.low[i] > a.high[i]) return false;
    return true;
}

}  // namespace

double distance(const Box& box, const Point& p) {
    double d[3];
    for (std::size_t i = 0; i < 3; ++i) d[i] = std::max({box.low[i] - p[i], p[i] - box.high[i], 0.0});
    return std::hypot(d[0], d[1], d[2]);
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), std::int64_t{0});
    if (!boxes_.empty()) grow(0, static_cast<std::int64_t>(boxes_.size()));
}

void BoxTree::grow(std::int64_t begin, std::int64_t end) {
    poll_cancel("mesh", 1 + (end - begin) / 16);
    Box hull = boxes_[index(order_[index(begin)])];
    for (std::int64_t k = begin; k < end; ++k) {
        const Box& box = boxes_[index(order_[index(k)])];
        for (std::size_t i = 0; i < 3; ++i) {
            hull.low[i] = std::min(hull.low[i], box.low[i]);
            hull.high[i] = std::max(hull.high[i], box.high[i]);
        }
    }
    const std::size_t self = branches_.size();
    branches_.push_back({hull, begin, end, 0});
    if (end - begin <= leaf_size) return;

    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (hull.high[i] - hull.low[i] > hull.high[axis] - hull.low[axis]) axis = i;
    const auto middle_of = [&](std::int64_t k) { return boxes_[index(k)].low[axis] + boxes_[index(k)].high[axis]; };
    const std::int64_t half = begin + (end - begin) / 2;
    std::nth_element(
        order_.begin() + begin, order_.begin() + half, order_.begin() + end,
        [&](std::int64_t a, std::int64_t b) { return std::pair(middle_of(a), a) < std::pair(middle_of(b), b); });
    grow(begin, half);
    branches_[self].right = static_cast<std::int64_t>(branches_.size());
    grow(half, end);
}

void BoxTree::containing(const Point& point, const std::function<void(std::int64_t)>& visit) const {
    meeting({point, point}, visit);
}

void BoxTree::meeting(const Box& box, const std::function<void(std::int64_t)>& visit) const {
    std::vector<std::size_t> open;
    if (!branches_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::size_t self = open.back();
        const Branch& branch = branches_[self];
        open.pop_back();
        if (!meet(branch.box, box)) continue;
        if (branch.right != 0) {
            open.push_back(index(branch.right));
            open.push_back(self + 1);
            continue;
        }
        for (std::int64_t k = branch.begin; k < branch.end; ++k)
            if (meet(boxes_[index(order_[index(k)])], box)) visit(order_[index(k)]);
    }
}

BoxTree::Nearest BoxTree::nearest(const Point& point, double limit) const {
    Nearest best{-1, limit};
    std::vector<std::size_t> open;
    if (!branches_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::size_t self = open.back();
        const Branch& branch = branches_[self];
        open.pop_back();
        if (distance(branch.box, point) > best.distance) continue;
        if (branch.right != 0) {
            std::size_t far = index(branch.right);
            std::size_t near = self + 1;
            if (distance(branches_[far].box, point) < distance(branches_[near].box, point)) std::swap(far, near);
            open.push_back(far);
            open.push_back(near);
            continue;
        }
        for (std::int64_t k = branch.begin; k < branch.end; ++k) {
            const std::int64_t i = order_[index(k)];
            const double d = distance(boxes_[index(i)], point);
            if (d < best.distance || (d == best.distance && (best.index < 0 || i < best.index))) best = {i, d};
        }
    }
    return best;
}

}  // namespace delam
