// SPDX-License-Identifier: BSD-3-Clause
// Hard cases over a range: a trial is one scene at one value of its parameter, computed by the condensed operator, FETI
// and the direct reference. Exported fields and numbers computed here decide whether a result is accepted.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "acceptance.hpp"
#include "direct.hpp"
#include "table.hpp"

namespace harness {

// An interface that nothing in these scenes damages.
inline constexpr reference::LawData intact{1e14, 1e14, 1e30, 1e30, 1e30, 1e30};

enum class Realisation { condensed, feti, direct };

// A state of one realisation. The direct reference has the adhesions of the analysis with which it is compared.
struct Result {
    Realisation realisation = Realisation::condensed;
    std::size_t step = 0;  // index into the trial's times
    double time = 0.0;
    std::vector<double> displacement, jump, traction, adhesion, mixity, reaction;
    std::vector<bool> contact;
    std::vector<double> factor, pattern;  // [patterns], of load and its conjugate
    double stored_bulk = 0.0, stored_interface = 0.0, load_potential = 0.0;
    double dissipated = 0.0, work = 0.0;  // cumulative; of the direct reference: NaN
};

// The quantities of a state that are unique and compared with the direct solution.
struct Compared {
    bool displacement = true, jump = true, traction = true, pattern = true, energy = true;
};

struct Trial {
    std::string subject;
    std::string parameter_name;
    double parameter = 0.0;
    std::function<reference::Scene()> scene;  // complete, except for reduction and subdomains
    std::vector<double> times{1.0};           // steps; the analysis starts at 0
    int subdomains = 4;                       // for FETI
    // Error of each step against a known solution; none: largest relative difference from the direct solution.
    std::function<double(const Result&)> error;
    std::string reference = "direct solver";
    Compared compared;
    std::optional<reference::LawData> law;  // of all interfaces with a law; none: damage is not judged
    double delta = 1e-5;                    // damage_tolerance of the scene
    double limit = 1e-10;                   // of the error, for "right to LIMIT"
    double direct_limit = 0.0;              // of the direct reference's own error; 0: the same
    double acceptance_limit = 1e-9;         // of the primal KKT and the recorded energies
    double defect_limit = 0.0;              // of the energy balance; 0: not judged (it decreases with the steps)
    double defect = 0.0;                    // the defect that theory predicts, over the largest energy
    // At least these scales are used to measure violations, for a scene that has no stress of its own.
    double least_traction = 0.0, least_force = 0.0, least_energy = 0.0;
    bool may_say = false;       // DELAM_NOT_CONVERGED is accepted too
    bool feti_may_say = false;  // for FETI alone
    std::string refused;        // expected: a refusal or outcome with these words
    bool condensed = true, feti = true, direct = true;
    std::string left_out;  // the reason why one of these is false; empty: no row mentions it
    // The scene with lengths in units of `unit`. The change of the energy of its direct solution shows what rounding of
    // the matrices leaves; the error may be twenty times that, up to 1e-2.
    std::function<reference::Scene(double unit)> in_unit;
    // A scene for the reference alone, with the same answer, in which every body is supported. None: the scene itself.
    std::function<reference::Scene()> held;
};

inline Trial trial_of(std::string subject, std::string parameter_name, double parameter) {
    Trial t;
    t.subject = std::move(subject);
    t.parameter_name = std::move(parameter_name);
    t.parameter = parameter;
    return t;
}

// The states of an analysis of the trial; throws Failure if it ends early.
std::vector<Result> states_of(const Trial& trial, Realisation realisation);

class Study {
public:
    explicit Study(const Options& options);
    const Options& options() const { return options_; }
    // True if the subject was requested; names it on stderr.
    bool wanted(const std::string& subject) const;
    // `also`: a trial of the same scene and times; the analyses are made once, and the rows of both follow.
    void run(const Trial& trial, const Trial* also = nullptr);
    // A row for a realisation with which the trial is not run.
    void leave_out(const Trial& trial, const std::string& realisation, const std::string& why);
    // A separate row, for a case that no trial describes.
    void row(const std::string& subject, const std::string& parameter_name, double parameter,
             const std::string& realisation, const std::string& reference, double error, double limit,
             const std::string& status, const std::string& expected, bool good, const std::string& message);
    Table& table() { return table_; }

    // The whole range, or with --quick every `stride`-th value of it and the last.
    std::vector<double> range(std::vector<double> values, std::size_t stride = 3) const;

private:
    const Options& options_;
    Table table_;
};

// Largest difference relative to the largest of b; 0 / 0 is 0.
double relative_difference(const std::vector<double>& a, const std::vector<double>& b);
double largest(const std::vector<double>& values);

// The piecewise-linear law, written independently of the library's, in extended precision.
struct OwnLaw {
    explicit OwnLaw(const reference::LawData& law);
    long double onset(long double mixity) const;
    long double toughness(long double mixity) const;
    long double driving(const double* jump, int dimension) const;
    long double mixity(const double* jump, int dimension) const;  // 0 if there is no jump
    // Minimiser below the old adhesion, and the energy dissipated down to an adhesion.
    long double adhesion(long double mixity, long double driving, long double old) const;
    long double spent(long double mixity, long double adhesion) const;
    reference::LawData data;
};

// Limit of the balance if nothing is damaged: the stored energy equals the work, except for rounding.
constexpr double closed_balance = 1e-10;

// ---- scenes of several subjects
// Two laws with a toughness of 200 and 400 J/m2. The process zone of the ductile one spans 8 to 16 pairs of the
// cantilever below, so that a long step has one critical state and every path ends there. That of the brittle one is a
// single pair: each set of broken pairs is then critical over a range of loads, and the path decides where a step ends.
constexpr reference::LawData ductile{1e12, 2e12, 10.0, 16.0, 200.0, 400.0};
constexpr reference::LawData brittle{1e13, 2e13, 50.0, 80.0, 200.0, 400.0};

// A cantilever of two arms in mixed mode: notched at the left, clamped at the right, lifted at the upper left corner.
struct Cantilever {
    int dimension = 2;
    double length = 0.04, arm = 2e-3, width = 0.01;
    std::int64_t columns = 40, rows = 2, ranks = 3;
    std::int64_t notch = 12;  // columns
    double young_lower = 70e9, young_upper = 70e9, poisson = 0.3;
    reference::LawData law = ductile;
    bool bonded = false;
    double lift = 1.5e-3;                  // at time 1
    std::vector<double> times{}, lifts{};  // used instead, if given
    std::int32_t cell = 0;                 // 0: quad4, hex8
    std::string formulation = "standard";
    double delta = 1e-5;
};
reference::Scene make_cantilever(const Cantilever& c);
// Begins the problem of a scene, of standard cells: the references of all subjects have them.
void begin_standard(reference::Scene& scene);

// Two bodies of one cell each, completely prescribed: the device prescribes the jump, (normal, tangential) in the two
// patterns "open" and "slide" over the same times. The interface has two pairs that respond alike.
reference::Scene make_driven(const reference::LawData& law, const std::vector<double>& times,
                             const std::vector<double>& open, const std::vector<double>& slide, double delta);

void stability_interface(Study& study);
void stability_bodies(Study& study);
void stability_units(Study& study);
void stability_contact(Study& study);
void stability_analysis(Study& study);
void stability_partition(Study& study);

}  // namespace harness
