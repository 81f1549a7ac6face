// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "petsc/base/objects.hpp"
#include "petsc/bodies/local_variables.hpp"

namespace delam::petsc {

// Response of the bodies in a state u = T v + U theta.
struct BodyState {
    std::vector<double> displacement;  // u at the rows of T
    std::vector<double> force;         // this rank's share of K u there
    double stored = 0.0;               // u.K u
    std::vector<double> work;          // f_p.u
    std::vector<double> lifted;        // U_p.(K u)
};

// The bodies in the variables v: A = T^T K T, never formed here, and the loads T^T (f_p - K U_p) of the patterns.
// Vectors have a place for each component of each node.
class Bodies {
public:
    Bodies(const Communicator& comm, const Part& part, const SceneVariables& scene);

    const Communicator& comm() const { return comm_; }
    const Part& part() const { return part_; }
    const Numbering& numbering() const { return numbering_; }
    const LocalVariables& local() const { return local_; }
    Vec diagonal() const { return diagonal_; }  // of A
    std::size_t patterns() const { return load_.size(); }
    Vec load(std::size_t pattern) const { return load_[pattern]; }
    OwnedVec vector() const;  // of zeros

    // av = A v
    void apply(Vec v, Vec av) const;
    // out = sum theta_p T^T (f_p - K U_p)
    void add_loads(std::span<const double> theta, Vec out) const;
    // u.K u for a v whose A v is known.
    double stored(std::span<const double> theta, Vec v, Vec av) const;
    BodyState state(std::span<const double> theta, Vec v) const;
    // out = T^T K u
    void forces(const BodyState& state, Vec out) const;
    // out += T^T f(theta)
    void add_nodal_forces(std::span<const double> theta, Vec out) const;
    // out = |T|^T |K| |u|, the sizes of the terms of T^T K u.
    void sizes(const BodyState& state, Vec out) const;
    // Both copy between this rank's places and a vector of all; assemble() sums what the ranks have.
    void assemble(std::span<const double> places, Vec out) const;
    void fetch(Vec from, std::vector<double>& places) const;

private:
    void make_diagonal();
    void make_loads();
    std::vector<double> stiffness_times(std::span<const double> displacement) const;

    const Communicator& comm_;
    const Part& part_;
    Numbering numbering_;
    LocalVariables local_;
    OwnedVec layout_;
    OwnedVec here_;  // this rank's places
    OwnedScatter fetch_;
    OwnedVec diagonal_;
    std::vector<OwnedVec> force_;                                        // T^T f_p
    std::vector<OwnedVec> load_;                                         // T^T (f_p - K U_p)
    std::vector<OwnedVec> lifted_;                                       // T^T K U_p
    std::vector<double> lift_lift_;                                      // U_p.K U_q
    mutable std::vector<double> places_, displacement_, force_of_part_;  // of `apply`, which then cannot fail
};

}  // namespace delam::petsc
