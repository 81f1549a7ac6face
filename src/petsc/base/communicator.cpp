// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/base/communicator.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <petscsys.h>

#include "base/numbers.hpp"

namespace delam::petsc {

namespace {

constexpr std::int64_t piece = std::int64_t{1} << 30;  // bytes of one message: MPI counts in int
constexpr int tag = 7;
// A rank that has failed waits that long for the others to notice. If they wait for this rank, they never come.
constexpr std::chrono::seconds longest_wait{8};

// Writes a message of a rank that can no longer reach the others. The host may redirect PETSc's error stream
// (PETSC_STDERR, PetscVFPrintf).
void say(const std::string& text) { PetscFPrintf(PETSC_COMM_SELF, PETSC_STDERR, "%s\n", text.c_str()); }

}  // namespace

Communicator::Communicator(MPI_Comm comm) {
    MPI_Comm_dup(comm, &comm_);
    MPI_Comm_dup(comm, &agreed_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

Communicator::~Communicator() {
    MPI_Comm_free(&comm_);
    MPI_Comm_free(&agreed_);
}

bool Communicator::come_in_time(MPI_Request& request) {
    const auto until = std::chrono::steady_clock::now() + longest_wait;
    int done = 0;
    while (true) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0) return true;
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void Communicator::agree(std::int32_t status, std::string text, Waits waits) const {
    int mine = status == DELAM_OK ? size_ : rank_, lowest = size_;
    MPI_Request request;
    MPI_Iallreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, agreed_, &request);
    if (status != DELAM_OK && waits != Waits::long_as_it_takes && !come_in_time(request)) {
        if (waits == Waits::then_aborts) {
            say("libdelam-petsc: one rank has failed and the others wait for it: " + text);
            MPI_Abort(agreed_, 1);
        }
        say("libdelam-petsc: the task of rank " + std::to_string(rank_) +
            " has failed, which waits for the others: " + text);
    }
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    count(4.0, 1.0);
    if (lowest == size_) return;
    MPI_Bcast(&status, 1, MPI_INT32_T, lowest, agreed_);
    int length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, lowest, agreed_);
    text.resize(index(length));
    MPI_Bcast(text.data(), length, MPI_CHAR, lowest, agreed_);
    throw Failure(status, text);
}

void Communicator::send_all(void* data, std::size_t bytes) const {
    auto* at = static_cast<char*>(data);
    for (auto left = static_cast<std::int64_t>(bytes); left > 0; left -= piece, at += piece) {
        const std::int64_t now = std::min(left, piece);
        MPI_Bcast(at, static_cast<int>(now), MPI_BYTE, 0, comm_);
        if (root() && size_ > 1) count(static_cast<double>(now), 1.0);
    }
}

void Communicator::broadcast(std::string& text) const {
    std::vector<char> letters(text.begin(), text.end());
    broadcast(letters);
    text.assign(letters.begin(), letters.end());
}

std::vector<std::int64_t> Communicator::exchange_sizes(const std::vector<std::int64_t>& bytes) const {
    std::vector<std::int64_t> arriving(bytes.size());
    MPI_Alltoall(bytes.data(), 1, MPI_INT64_T, arriving.data(), 1, MPI_INT64_T, comm_);
    count(8.0 * size_, size_);
    return arriving;
}

void Communicator::exchange_bytes(const std::vector<const void*>& data, const std::vector<std::int64_t>& bytes,
                                  const std::vector<void*>& places, const std::vector<std::int64_t>& arriving) const {
    std::vector<MPI_Request> requests;
    const auto pieces = [&](std::size_t r, std::int64_t total, auto&& one) {
        for (std::int64_t at = 0; at < total; at += piece) {
            requests.emplace_back();
            one(at, static_cast<int>(std::min(piece, total - at)), static_cast<int>(r), requests.back());
        }
    };
    for (std::size_t r = 0; r < places.size(); ++r)
        pieces(r, arriving[r], [&](std::int64_t at, int length, int rank, MPI_Request& request) {
            MPI_Irecv(static_cast<char*>(places[r]) + at, length, MPI_BYTE, rank, tag, comm_, &request);
        });
    for (std::size_t r = 0; r < data.size(); ++r)
        pieces(r, bytes[r], [&](std::int64_t at, int length, int rank, MPI_Request& request) {
            MPI_Isend(static_cast<const char*>(data[r]) + at, length, MPI_BYTE, rank, tag, comm_, &request);
            if (rank != rank_) count(length, 1.0);
        });
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void Communicator::send(int to, const std::vector<std::uint8_t>& bytes) const {
    const auto total = static_cast<std::int64_t>(bytes.size());
    MPI_Send(&total, 1, MPI_INT64_T, to, tag, comm_);
    for (std::int64_t at = 0; at < total; at += piece)
        MPI_Send(bytes.data() + at, static_cast<int>(std::min(piece, total - at)), MPI_BYTE, to, tag, comm_);
    count(static_cast<double>(total) + 8.0, 2.0);
}

std::vector<std::uint8_t> Communicator::receive() const {
    std::int64_t total = 0;
    MPI_Recv(&total, 1, MPI_INT64_T, 0, tag, comm_, MPI_STATUS_IGNORE);
    std::vector<std::uint8_t> bytes(index(total));
    for (std::int64_t at = 0; at < total; at += piece)
        MPI_Recv(bytes.data() + at, static_cast<int>(std::min(piece, total - at)), MPI_BYTE, 0, tag, comm_,
                 MPI_STATUS_IGNORE);
    return bytes;
}

void Communicator::sum(std::vector<double>& values) const {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

double Communicator::sum(double value) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm_);
    return value;
}

double Communicator::largest(double value) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
    return value;
}

std::int64_t Communicator::largest(std::int64_t value) const {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_MAX, comm_);
    return value;
}

}  // namespace delam::petsc
