// SPDX-License-Identifier: BSD-3-Clause
// Interface laws, including those of the host. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_LAW_HPP
#define DELAM_CPP_LAW_HPP

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "delam/cpp/argument.hpp"
#include "delam/cpp/context.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

// What a host law returns: adhesion in [0, 1], and its derivative by the driving force.
struct AdhesionValue {
    double adhesion, slope;
};
// What a host law returns: dissipated energy per area, and its derivatives by adhesion and mixity.
struct DissipationValue {
    double dissipated, slope, mixity_slope;
};
// The two functions of a host law (delam_law_create_host). They report failure by an exception.
using AdhesionCallback = std::function<AdhesionValue(double mixity, double driving)>;
using DissipationCallback = std::function<DissipationValue(double mixity, double adhesion)>;

namespace detail {

struct HostLaw {
    AdhesionCallback adhesion;
    DissipationCallback dissipation;
};

}  // namespace detail

// Energy release rates at onset and at full decohesion, one for each mixity.
struct Toughness {
    std::vector<double> onset, toughness;
};
// Adhesion, and traction [count][dimension], one for each jump.
struct Response {
    std::vector<double> adhesion, traction;
};

// The law of an interface: its kind and parameters, or two functions of the host.
class Law {
public:
    Law(const Context& context, Text kind) : shared_(context.shared()) {
        delam_law* made = nullptr;
        const auto status = delam_law_create(context.get(), kind.get(), &made);
        handle_.reset(made);
        shared_->check(status);
    }
    // A law computed by the host's functions; name identifies them in messages and in the hash of a problem.
    Law(const Context& context, Text name, AdhesionCallback adhesion, DissipationCallback dissipation)
        : shared_(context.shared()),
          host_(std::make_shared<detail::HostLaw>(detail::HostLaw{std::move(adhesion), std::move(dissipation)})) {
        detail::require(host_->adhesion && host_->dissipation, "a law needs both functions");
        delam_law* made = nullptr;
        const auto status = delam_law_create_host(context.get(), name.get(), &Law::adhesion_of, &Law::dissipation_of,
                                                  host_.get(), &made);
        handle_.reset(made);
        shared_->check(status);
    }

    // Returns the handle of C.
    delam_law* get() const noexcept { return handle_.get(); }
    void set(Text key, double value) { shared_->check(delam_law_set(get(), key.get(), value)); }
    void set(Text key, Text value) { shared_->check(delam_law_set_text(get(), key.get(), value.get())); }
    void set_table(View<double> xi, View<double> s) {
        detail::require(xi.size() == s.size(), "xi and s: unequal sizes");
        shared_->check(delam_law_set_table(get(), xi.count(), xi.data(), s.data()));
    }
    void check() const { shared_->check(delam_law_check(get())); }
    Toughness toughness(View<double> mixity) const {
        Toughness values;
        values.onset.resize(mixity.size());
        values.toughness.resize(mixity.size());
        shared_->check(
            delam_law_toughness(get(), mixity.count(), mixity.data(), values.onset.data(), values.toughness.data()));
        return values;
    }
    // jump: [count][dimension]
    Response respond(std::int32_t dimension, View<double> jump, View<double> mixity, View<double> adhesion_old) const {
        detail::require(dimension > 0 && jump.size() == mixity.size() * detail::length(dimension) &&
                            adhesion_old.size() == mixity.size(),
                        "jump, mixity and adhesion_old: unequal sizes");
        Response response;
        response.adhesion.resize(mixity.size());
        response.traction.resize(jump.size());
        shared_->check(delam_law_respond(get(), dimension, mixity.count(), jump.data(), mixity.data(),
                                         adhesion_old.data(), response.adhesion.data(), response.traction.data()));
        return response;
    }

    // Returns the functions of the host, which problems keep; null for other laws.
    const std::shared_ptr<detail::HostLaw>& host() const noexcept { return host_; }

private:
    template <class Call>
    static std::int32_t run(Call&& call) noexcept {
        if (detail::thrown) return 1;
        try {
            call();
            return 0;
        } catch (...) {
            detail::thrown = std::current_exception();
            return 1;
        }
    }
    static std::int32_t adhesion_of(double mixity, double driving, double* adhesion, double* slope, void* user) {
        const auto& law = *static_cast<const detail::HostLaw*>(user);
        return run([&] {
            const AdhesionValue value = law.adhesion(mixity, driving);
            *adhesion = value.adhesion;
            *slope = value.slope;
        });
    }
    static std::int32_t dissipation_of(double mixity, double adhesion, double* dissipated, double* slope,
                                       double* mixity_slope, void* user) {
        const auto& law = *static_cast<const detail::HostLaw*>(user);
        return run([&] {
            const DissipationValue value = law.dissipation(mixity, adhesion);
            *dissipated = value.dissipated;
            *slope = value.slope;
            *mixity_slope = value.mixity_slope;
        });
    }

    std::shared_ptr<detail::Shared> shared_;
    std::shared_ptr<detail::HostLaw> host_;
    detail::Handle<delam_law, delam_law_destroy> handle_;
};

}  // namespace delam

#endif
