// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"

namespace delam::petsc {

// The ranks that work together, on a communicator of their own. What can fail on one rank alone runs inside `together`:
// no rank leaves it before all know whether all of them have succeeded.
class Communicator {
public:
    explicit Communicator(MPI_Comm comm);
    ~Communicator();
    Communicator(const Communicator&) = delete;
    Communicator& operator=(const Communicator&) = delete;

    MPI_Comm get() const { return comm_; }
    int rank() const { return rank_; }
    int size() const { return size_; }
    bool root() const { return rank_ == 0; }

    // Runs work on each rank, work of its own; if it throws on any, all ranks throw what the lowest of these has
    // thrown.
    template <class Work>
    void together(Work&& work) const {
        agree(work, Waits::long_as_it_takes);
    }
    // The same for work with steps that all ranks share: a rank that fails in such a step waits for the others, who may
    // wait for it, for some seconds only.
    template <class Work>
    void in_step(Work&& work) const {
        agree(work, Waits::then_aborts);
    }
    // The same as `together` for work of a host, which may take any time: a rank that has failed says so if it waits
    // long, because the host may have made the others wait for it.
    template <class Work>
    void in_task(Work&& work) const {
        agree(work, Waits::then_says_so);
    }

    template <class Value>
    void broadcast(Value& value) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        send_all(&value, sizeof value);
    }
    // Rank 0's vector, its length included.
    template <class Value>
    void broadcast(std::vector<Value>& values) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::int64_t count = static_cast<std::int64_t>(values.size());
        broadcast(count);
        together([&] { values.resize(index(count)); });
        send_all(values.data(), values.size() * sizeof(Value));
    }
    void broadcast(std::string& text) const;

    // Sends outgoing[r] to rank r and returns what each rank has sent to this one.
    template <class Value>
    std::vector<std::vector<Value>> exchange(const std::vector<std::vector<Value>>& outgoing) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::vector<const void*> data;
        std::vector<std::int64_t> bytes;
        for (const std::vector<Value>& part : outgoing) {
            data.push_back(part.data());
            bytes.push_back(static_cast<std::int64_t>(part.size() * sizeof(Value)));
        }
        const std::vector<std::int64_t> arriving = exchange_sizes(bytes);
        std::vector<std::vector<Value>> incoming(outgoing.size());
        std::vector<void*> places;
        together([&] {
            for (std::size_t r = 0; r < incoming.size(); ++r) incoming[r].resize(index(arriving[r]) / sizeof(Value));
        });
        for (std::vector<Value>& part : incoming) places.push_back(part.data());
        exchange_bytes(data, bytes, places, arriving);
        return incoming;
    }

    // Bytes from rank 0 to another; call it on these two only.
    void send(int to, const std::vector<std::uint8_t>& bytes) const;
    std::vector<std::uint8_t> receive() const;

    void sum(std::vector<double>& values) const;
    double sum(double value) const;
    double largest(double value) const;
    std::int64_t largest(std::int64_t value) const;

    double bytes_sent() const { return bytes_sent_; }
    double messages_sent() const { return messages_; }

private:
    // Behaviour of a rank that has failed, until the others agree.
    enum class Waits { long_as_it_takes, then_says_so, then_aborts };
    template <class Work>
    void agree(Work&& work, Waits waits) const {
        Failure failure(DELAM_OK, "");
        try {
            work();
        } catch (...) {
            failure = current_failure();
        }
        agree(failure.status, failure.what(), waits);
    }
    // Throws on all ranks if a status is not DELAM_OK on any.
    void agree(std::int32_t status, std::string text, Waits waits) const;
    // Waits some seconds: whether the others have come.
    static bool come_in_time(MPI_Request& request);
    void send_all(void* data, std::size_t bytes) const;
    std::vector<std::int64_t> exchange_sizes(const std::vector<std::int64_t>& bytes) const;
    void exchange_bytes(const std::vector<const void*>& data, const std::vector<std::int64_t>& bytes,
                        const std::vector<void*>& places, const std::vector<std::int64_t>& arriving) const;
    void count(double bytes, double messages) const {
        bytes_sent_ += bytes;
        messages_ += messages;
    }

    MPI_Comm comm_ = MPI_COMM_NULL;    // of all objects
    MPI_Comm agreed_ = MPI_COMM_NULL;  // of agreements only, so that a late rank cannot mistake them for other traffic
    int rank_ = 0;
    int size_ = 1;
    mutable double bytes_sent_ = 0.0;
    mutable double messages_ = 0.0;
};

}  // namespace delam::petsc
