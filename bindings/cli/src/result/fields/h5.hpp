// SPDX-License-Identifier: BSD-3-Clause
// Owners of HDF5 identifiers and the few calls that the program needs. Every failure is an OutputFailure.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include <hdf5.h>

#include "result/fields/h5_driver.hpp"
#include "text/error.hpp"
#include "text/reason.hpp"

namespace cli::h5 {

// Throws what went wrong with a file, by its own name and the system's reason where there is one: HDF5 gives none.
[[noreturn]] inline void refuse(const std::string& what, const char* otherwise) {
    const FileTrouble trouble = take_trouble();
    if (trouble.code == ENOMEM) throw std::bad_alloc();
    if (trouble.code != 0) throw OutputFailure(trouble.path, reason_of(trouble.code));
    throw OutputFailure(what, otherwise);
}

template <herr_t (*Close)(hid_t)>
class Id {
public:
    Id(hid_t id, const std::string& what) : id_(id) {
        if (id < 0) refuse(what, "HDF5 refused (file damaged?)");
    }
    ~Id() {
        if (id_ >= 0) Close(id_);
    }
    Id(const Id&) = delete;
    Id& operator=(const Id&) = delete;
    [[nodiscard]] hid_t get() const { return id_; }
    // Closing a file writes its buffered data, which can fail.
    void close(const std::string& what) {
        const hid_t id = id_;
        id_ = -1;
        const bool closed = Close(id) >= 0;
        if (const FileTrouble trouble = take_trouble(); trouble.code != 0)
            throw OutputFailure(trouble.path, reason_of(trouble.code));
        if (!closed) throw OutputFailure(what, "HDF5 refused to close it");
    }

private:
    hid_t id_;
};

using File = Id<H5Fclose>;
using Group = Id<H5Gclose>;
using Space = Id<H5Sclose>;
using Data = Id<H5Dclose>;
using Attribute = Id<H5Aclose>;
using Properties = Id<H5Pclose>;
using Type = Id<H5Tclose>;

// Creates the file; replaces an earlier one.
inline hid_t create(const std::string& path) {
    (void)take_trouble();
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, driver_access());
}
inline hid_t open(const std::string& path) { return H5Fopen(path.c_str(), H5F_ACC_RDONLY, driver_access()); }

inline void require(herr_t status, const std::string& what) {
    if (status < 0) refuse(what, "HDF5 could not write");
}

template <class T>
hid_t type_of();
template <>
inline hid_t type_of<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t type_of<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
inline hid_t type_of<std::int32_t>() {
    return H5T_NATIVE_INT32;
}

// Arrays of more bytes are compressed. Reason: packing a field of the ENF takes two to three times the instructions of
// recovering it and saves half of its bytes, which counts where files are large: twenty instants of arrays below this
// size are tens of MB. Measured as `valgrind --tool=callgrind delam run examples/enf/enf.toml --set output.every=40`
// with 4 KiB instead: deflate takes 310 M of 1,420 M instructions at 11 instants. Half of it packs stresses from 11,000
// cells on; twice of it leaves twice the bytes of a run with 40,000 cells.
inline constexpr std::size_t least_packed_bytes = std::size_t{1} << 20;

// columns 0: a vector.
inline void write(hid_t parent, const std::string& name, hid_t type, const void* values, std::int64_t rows,
                  std::int64_t columns) {
    const hsize_t shape[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
    const std::int64_t count = rows * (columns > 0 ? columns : 1);
    const Space space(H5Screate_simple(columns > 0 ? 2 : 1, shape, nullptr), name);
    const Properties properties(H5Pcreate(H5P_DATASET_CREATE), name);
    // A date of its own would make each file of a result another.
    require(H5Pset_obj_track_times(properties.get(), false), name);
    if (static_cast<std::size_t>(count) * H5Tget_size(type) > least_packed_bytes) {
        require(H5Pset_chunk(properties.get(), columns > 0 ? 2 : 1, shape), name);
        require(H5Pset_shuffle(properties.get()), name);
        require(H5Pset_deflate(properties.get(), 1), name);
    }
    const Data data(H5Dcreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                    name);
    if (count > 0) require(H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
}

template <class T>
void write(hid_t parent, const std::string& name, const std::vector<T>& values, std::size_t columns) {
    const auto rows = static_cast<std::int64_t>(values.size() / (columns > 0 ? columns : 1));
    write(parent, name, type_of<T>(), values.data(), rows, static_cast<std::int64_t>(columns));
}

// Room for a matrix of doubles, whose bytes others write: one behind the other, from the returned offset of the file
// on.
inline std::int64_t reserve(hid_t parent, const std::string& name, std::int64_t rows, std::int64_t columns) {
    const hsize_t shape[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
    const Space space(H5Screate_simple(2, shape, nullptr), name);
    const Properties properties(H5Pcreate(H5P_DATASET_CREATE), name);
    require(H5Pset_obj_track_times(properties.get(), false), name);
    require(H5Pset_layout(properties.get(), H5D_CONTIGUOUS), name);
    require(H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_EARLY), name);
    require(H5Pset_fill_time(properties.get(), H5D_FILL_TIME_NEVER), name);
    const Data data(
        H5Dcreate2(parent, name.c_str(), H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
        name);
    const haddr_t offset = H5Dget_offset(data.get());
    if (offset == HADDR_UNDEF) throw OutputFailure(name, "HDF5 gave it no place in the file");
    return static_cast<std::int64_t>(offset);
}

inline void attribute(hid_t parent, const std::string& name, hid_t type, const void* value) {
    const Space space(H5Screate(H5S_SCALAR), name);
    const Attribute out(H5Acreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), name);
    require(H5Awrite(out.get(), type, value), name);
}
template <class T>
void attribute(hid_t parent, const std::string& name, T value) {
    attribute(parent, name, type_of<T>(), &value);
}

inline void attribute(hid_t parent, const std::string& name, const std::string& value) {
    const Space space(H5Screate(H5S_SCALAR), name);
    const Type type(H5Tcopy(H5T_C_S1), name);
    require(H5Tset_size(type.get(), value.size() + 1), name);
    require(H5Tset_cset(type.get(), H5T_CSET_UTF8), name);
    const Attribute out(H5Acreate2(parent, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), name);
    require(H5Awrite(out.get(), type.get(), value.c_str()), name);
}

inline double read_number(hid_t parent, const std::string& name) {
    const Attribute in(H5Aopen(parent, name.c_str(), H5P_DEFAULT), name);
    double value = 0;
    require(H5Aread(in.get(), H5T_NATIVE_DOUBLE, &value), name);
    return value;
}

// NaN: the attribute is missing.
inline double read_number_if_there(hid_t parent, const std::string& name) {
    if (H5Aexists(parent, name.c_str()) <= 0) return std::numeric_limits<double>::quiet_NaN();
    return read_number(parent, name);
}

inline hid_t new_group(hid_t parent, const std::string& name) {
    return H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

}  // namespace cli::h5
