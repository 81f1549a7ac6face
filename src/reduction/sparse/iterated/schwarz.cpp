// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/schwarz.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/dense/dense.hpp"

namespace delam {

void Schwarz::set_free(std::vector<std::vector<double>> motions) {
    null_.clear();
    for (std::vector<double>& motion : motions) {
        system_.space().reduce(motion);
        for (int pass = 0; pass < 2; ++pass)
            for (const std::vector<double>& other : null_) add_scaled(-dot(other, motion), other, motion);
        const double length = std::sqrt(dot(motion, motion));
        if (!(length > 0.0)) continue;
        for (double& m : motion) m /= length;
        null_.push_back(std::move(motion));
    }
}

void Schwarz::project(std::span<double> x) const {
    for (const std::vector<double>& motion : null_) add_scaled(-dot(motion, x), motion, x);
}

// work_ = r - A z, in the reduced space, for A z in image_.
void Schwarz::subtract_image(std::span<const double> r) {
    for (std::size_t i = 0; i < work_.size(); ++i) work_[i] = r[i] - image_[i];
    system_.space().gather(work_);
    project(work_);
}

void Schwarz::apply(std::span<const double> r, std::span<double> z) {
    const ReducedSpace& space = system_.space();
    work_.resize(r.size());
    image_.resize(r.size());
    std::fill(z.begin(), z.end(), 0.0);
    const bool patched = patches_.count() > 0;
    if (patched) {
        patches_.add(r, z);
        space.spread(z);
        system_.apply_sparse(z, image_);
        subtract_image(r);
    } else {
        std::copy(r.begin(), r.end(), work_.begin());
    }
    factor_.whole().apply(work_, image_);
    space.spread(image_);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += image_[i];
    if (patched) {
        if (null_.empty())
            system_.apply(z, image_, patches_.members());
        else
            system_.apply(z, image_);
        subtract_image(r);
        std::fill(image_.begin(), image_.end(), 0.0);
        patches_.add(work_, image_);
        space.spread(image_);
        for (std::size_t i = 0; i < z.size(); ++i) z[i] += image_[i];
    }
}

}  // namespace delam
