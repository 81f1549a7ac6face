// SPDX-License-Identifier: BSD-3-Clause
// PETSc's objects with an owner. All but those of one process are destroyed together, in the same order on all ranks.
#pragma once

#include <utility>

#include <petscksp.h>

namespace delam::petsc {

template <class Handle, PetscErrorCode (*destroy)(Handle*)>
class Owned {
public:
    Owned() = default;
    explicit Owned(Handle value) : value_(value) {}
    ~Owned() { reset(); }
    Owned(Owned&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) {
            reset();
            value_ = std::exchange(other.value_, nullptr);
        }
        return *this;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;

    operator Handle() const { return value_; }
    // Returns the place where a create function stores a new object.
    Handle* out() {
        reset();
        return &value_;
    }
    void reset() {
        if (value_ != nullptr) destroy(&value_);
        value_ = nullptr;
    }

private:
    Handle value_ = nullptr;
};

using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedIs = Owned<IS, ISDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;
using OwnedMapping = Owned<ISLocalToGlobalMapping, ISLocalToGlobalMappingDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedPc = Owned<PC, PCDestroy>;

}  // namespace delam::petsc
