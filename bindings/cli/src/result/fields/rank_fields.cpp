// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/rank_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "file/ranged_file.hpp"
#include "model/library/call.hpp"

namespace cli {

namespace {

enum class Job : std::int32_t { gather, write, copy };
// Bytes that are copied at a time.
constexpr std::int64_t piece = std::int64_t{1} << 26;

// Message of rank 0 to the others.
class Telling {
public:
    explicit Telling(Job job) { put(job); }
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t before = bytes_.size();
        bytes_.resize(before + sizeof value);
        std::memcpy(&bytes_[before], &value, sizeof value);
    }
    void put(const std::string& text) {
        put(static_cast<std::int64_t>(text.size()));
        bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

// Why a task fails: a status of the library and words.
struct Trouble : std::runtime_error {
    Trouble(std::int32_t which, const std::string& text) : std::runtime_error(text), status(which) {}
    std::int32_t status;
};

struct Quiet {};

Trouble current_trouble() {
    try {
        throw;
    } catch (const Trouble& trouble) {
        return trouble;
    } catch (const std::bad_alloc&) {
        return {DELAM_ERROR_MEMORY, "not enough memory for the fields"};
    } catch (const std::exception& error) {
        return {DELAM_ERROR_INTERNAL, error.what()};
    }
}

void require_file(int code, const char* doing) {
    if (code != 0) throw Trouble(DELAM_ERROR_FILE, fmt::format("{}: {}", doing, std::strerror(code)));
}

class RowType {
public:
    explicit RowType(std::size_t columns) {
        MPI_Type_contiguous(static_cast<int>(columns), MPI_DOUBLE, &type_);
        MPI_Type_commit(&type_);
    }
    ~RowType() { MPI_Type_free(&type_); }
    RowType(const RowType&) = delete;
    RowType& operator=(const RowType&) = delete;
    MPI_Datatype get() const { return type_; }

private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

// Copies the bytes from first to last of ranges that lie one behind the other.
void copy_share(const std::string& path, const std::vector<FileRange>& ranges, std::int64_t first, std::int64_t last) {
    std::vector<char> bytes(static_cast<std::size_t>(std::min(piece, last - first)));
    RangedFile to(path, RangedFile::Mode::write);
    require_file(to.code(), "open");
    std::int64_t before = 0;
    for (const FileRange& range : ranges) {
        const std::int64_t begin = std::max(first, before), end = std::min(last, before + range.bytes);
        if (begin < end) {
            RangedFile from(range.from, RangedFile::Mode::read);
            require_file(from.code(), "open");
            for (std::int64_t at = begin; at < end; at += piece) {
                const std::int64_t now = std::min(piece, end - at);
                require_file(from.read(range.offset + at - before, bytes.data(), now), "read");
                require_file(to.write(range.to + at - before, bytes.data(), now), "write");
            }
        }
        before += range.bytes;
    }
    require_file(to.sync(), "write");
    require_file(to.close(), "close");
}

std::vector<int> begins_of(const std::vector<int>& counts) {
    std::vector<int> begins(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, begins.begin() + 1);
    return begins;
}

}  // namespace

// Message from rank 0, read in the order in which it was written.
class RankFields::Told {
public:
    Told(std::int64_t size, const std::uint8_t* bytes) : at_(bytes), end_(bytes + size) {}
    template <class T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }
    std::string text() {
        const auto length = static_cast<std::size_t>(get<std::int64_t>());
        return {reinterpret_cast<const char*>(take(length)), length};
    }

private:
    const std::uint8_t* take(std::size_t count) {
        if (static_cast<std::size_t>(end_ - at_) < count) throw std::runtime_error("a task's bytes end early");
        return std::exchange(at_, at_ + count);
    }
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

RankFields::RankFields(delam_petsc* petsc) : petsc_(petsc) {
    MPI_Comm_dup(MPI_COMM_WORLD, &comm_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
    if (delam_petsc_set_task(petsc, task, this) != DELAM_OK) throw Failure(exit_numerical, delam_petsc_message(petsc));
}

RankFields::~RankFields() { MPI_Comm_free(&comm_); }

std::int32_t RankFields::task(std::int64_t size, const std::uint8_t* bytes, void* user) {
    auto& self = *static_cast<RankFields*>(user);
    try {
        Told told(size, bytes);
        switch (told.get<Job>()) {
            case Job::gather:
                self.gather(told);
                break;
            case Job::write:
                self.write_rows(told);
                break;
            case Job::copy:
                self.copy_ranges(told);
                break;
        }
        return DELAM_OK;
    } catch (const Quiet&) {
        return DELAM_OK;
    } catch (...) {
        const Trouble trouble = current_trouble();
        delam_petsc_explain(self.petsc_, fmt::format("rank {}: {}", self.rank_, trouble.what()).c_str());
        return trouble.status;
    }
}

void RankFields::everywhere(const std::vector<std::uint8_t>& bytes, const std::string& path) const {
    const std::int32_t status = delam_petsc_everywhere(petsc_, static_cast<std::int64_t>(bytes.size()), bytes.data());
    if (status == DELAM_OK) return;
    const std::string why = delam_petsc_message(petsc_);
    if (status == DELAM_ERROR_FILE) throw OutputFailure(path, why);
    throw Failure(exit_numerical, why);
}

// The others stop without a word: they have no reason of their own, and the rank that has one tells it.
template <class Work>
void RankFields::together(Work&& work) const {
    Trouble own(DELAM_OK, "");
    try {
        work();
    } catch (...) {
        own = current_trouble();
    }
    int lowest = own.status == DELAM_OK ? size_ : rank_;
    MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, comm_);
    if (lowest == size_) return;
    if (lowest != rank_) throw Quiet();
    throw own;
}

// Checks the status of a call that one rank makes alone.
void RankFields::call(std::int32_t status) const {
    if (status != DELAM_OK) throw Trouble(status, delam_petsc_message(petsc_));
}

std::vector<std::int64_t> RankFields::nodes(std::vector<std::int32_t>& owned) const {
    std::int64_t count = 0;
    call(delam_petsc_part_nodes(petsc_, 0, nullptr, nullptr, &count));
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(count));
    owned.resize(nodes.size());
    call(delam_petsc_part_nodes(petsc_, count, nodes.data(), owned.data(), nullptr));
    return nodes;
}

std::vector<std::int64_t> RankFields::cells() const {
    std::int64_t count = 0;
    call(delam_petsc_part_cells(petsc_, 0, nullptr, &count));
    std::vector<std::int64_t> cells(static_cast<std::size_t>(count));
    call(delam_petsc_part_cells(petsc_, count, cells.data(), nullptr));
    return cells;
}

Field RankFields::field(const std::string& key) const {
    std::int64_t rows = 0, columns = 0;
    call(delam_petsc_part_field(petsc_, key.c_str(), 0, nullptr, &rows, &columns));
    Field field{std::vector<double>(static_cast<std::size_t>(rows * columns)), static_cast<std::size_t>(rows),
                static_cast<std::size_t>(columns)};
    call(delam_petsc_part_field(petsc_, key.c_str(), rows * columns, field.values.data(), nullptr, nullptr));
    return field;
}

Field RankFields::rows_to_write(const BulkField& of, std::vector<std::int64_t>& rows) const {
    const Field all = stored(of, field(of.name));
    if (!of.of_nodes) {
        rows = cells();
        return all;
    }
    std::vector<std::int32_t> owned;
    const std::vector<std::int64_t> numbers = nodes(owned);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (owned[i] != 0) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    Field own{{}, order.size(), of.columns};
    own.values.reserve(order.size() * of.columns);
    for (const std::size_t i : order) {
        rows.push_back(numbers[i]);
        const auto begin = all.values.begin() + static_cast<std::ptrdiff_t>(i * of.columns);
        own.values.insert(own.values.end(), begin, begin + static_cast<std::ptrdiff_t>(of.columns));
    }
    return own;
}

// ---- the displacements that rank 0 wants

std::vector<double> RankFields::recover(const Model& model, delam_solver* solver,
                                        const std::vector<std::int64_t>& nodes) {
    if (const std::int32_t status = delam_petsc_recover(petsc_, solver); status != DELAM_OK) {
        if (status == DELAM_CANCELLED) throw Failure(exit_interrupted, "interrupted");
        // The context knows why only where the library itself has failed.
        const std::string said = delam_petsc_message(petsc_), own = delam_context_message(model.context.get());
        throw Failure(exit_numerical, "displacements: " + said + (own.empty() ? "" : ": " + own));
    }
    Telling telling(Job::gather);
    telling.put(static_cast<std::int64_t>(nodes.size()));
    for (const std::int64_t node : nodes) telling.put(node);
    everywhere(telling.bytes(), "fields.h5");
    return std::move(gathered_);
}

void RankFields::gather(Told& told) {
    struct Sent {
        std::int64_t place;
        double u[3];
    };
    std::vector<Sent> mine;
    std::vector<int> counts, begins;
    std::size_t asked = 0;
    double largest = 0.0;
    together([&] {
        std::vector<std::int64_t> wanted(static_cast<std::size_t>(told.get<std::int64_t>()));
        for (std::int64_t& node : wanted) node = told.get<std::int64_t>();
        asked = wanted.size();
        std::vector<std::int32_t> owned;
        const std::vector<std::int64_t> numbers = nodes(owned);
        const Field u = stored({"displacement", true, 3}, field("displacement"));
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto found = std::lower_bound(wanted.begin(), wanted.end(), numbers[i]);
            if (owned[i] == 0 || found == wanted.end() || *found != numbers[i]) continue;
            mine.push_back({found - wanted.begin(), {u.values[3 * i], u.values[3 * i + 1], u.values[3 * i + 2]}});
        }
        const Field rotation = field("rotation");
        for (std::size_t c = 0; c < rotation.rows; ++c) {
            double square = 0.0;
            for (std::size_t k = 0; k < rotation.columns; ++k)
                square += rotation.values[c * rotation.columns + k] * rotation.values[c * rotation.columns + k];
            largest = std::max(largest, std::sqrt(square));
        }
        counts.resize(static_cast<std::size_t>(size_));
        begins.resize(static_cast<std::size_t>(size_));
    });
    MPI_Reduce(&largest, &largest_rotation_, 1, MPI_DOUBLE, MPI_MAX, 0, comm_);
    const int count = static_cast<int>(mine.size());
    MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm_);
    std::vector<Sent> all;
    together([&] {
        if (rank_ != 0) return;
        for (std::size_t r = 1; r < begins.size(); ++r) begins[r] = begins[r - 1] + counts[r - 1];
        all.resize(static_cast<std::size_t>(begins.back() + counts.back()));
        if (all.size() != asked)
            throw std::runtime_error(fmt::format("the ranks have {} of {} nodes at interfaces", all.size(), asked));
    });
    MPI_Datatype sent = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(static_cast<int>(sizeof(Sent)), MPI_BYTE, &sent);
    MPI_Type_commit(&sent);
    MPI_Gatherv(mine.data(), count, sent, all.data(), counts.data(), begins.data(), sent, 0, comm_);
    MPI_Type_free(&sent);
    if (rank_ != 0) return;
    gathered_.assign(3 * asked, 0.0);
    for (const Sent& one : all) std::copy_n(one.u, 3, gathered_.begin() + 3 * one.place);
}

// ---- a step

void RankFields::write(const std::string& path, const std::vector<Room>& rooms) {
    Telling telling(Job::write);
    telling.put(path);
    telling.put(static_cast<std::int64_t>(rooms.size()));
    for (const Room& room : rooms) {
        telling.put(room.field.name);
        telling.put(static_cast<std::int32_t>(room.field.of_nodes ? 1 : 0));
        telling.put(static_cast<std::int64_t>(room.field.columns));
        telling.put(room.rows);
        telling.put(room.offset);
    }
    everywhere(telling.bytes(), path);
}

void RankFields::write_rows(Told& told) {
    std::string path;
    std::vector<Room> rooms;
    together([&] {
        path = told.text();
        rooms.resize(static_cast<std::size_t>(told.get<std::int64_t>()));
        for (Room& room : rooms) {
            room.field.name = told.text();
            room.field.of_nodes = told.get<std::int32_t>() != 0;
            room.field.columns = static_cast<std::size_t>(told.get<std::int64_t>());
            room.rows = told.get<std::int64_t>();
            room.offset = told.get<std::int64_t>();
        }
    });
    RangedFile file(path, RangedFile::Mode::write);
    together([&] { require_file(file.code(), "open"); });
    int code = 0;
    for (const Room& room : rooms) {
        std::int64_t first = 0;
        const std::vector<double> rows = block_of_rows(room, first);
        const std::int64_t row_bytes = 8 * static_cast<std::int64_t>(room.field.columns);
        const int written = file.write(room.offset + first * row_bytes, rows.data(), 8 * std::ssize(rows));
        if (code == 0) code = written;
    }
    if (const int synced = file.sync(); code == 0) code = synced;
    const int closed = file.close();
    together([&] {
        require_file(code, "write");
        require_file(closed, "close");
    });
}

// The rows of a part lie scattered in a field. The ranks therefore exchange them, so that each has a block of rows, and
// writes it in one piece. (MPI_File_write_all would do the same, but Open MPI 4.1 does not tell when a write fails, and
// a rank without memory for MPI_File_open ends by a signal.)
std::vector<double> RankFields::block_of_rows(const Room& room, std::int64_t& first) const {
    const std::int64_t share = std::max<std::int64_t>(1, (room.rows + size_ - 1) / size_);
    const std::size_t columns = room.field.columns;
    first = std::min(room.rows, share * rank_);
    const std::int64_t count = std::min(room.rows, first + share) - first;
    std::vector<std::int64_t> mine, arrived;
    Field values;
    std::vector<int> sent, received;
    std::vector<double> rows, block;
    together([&] {
        values = rows_to_write(room.field, mine);
        sent.resize(static_cast<std::size_t>(size_));
        received.resize(sent.size());
        for (const std::int64_t row : mine) ++sent[static_cast<std::size_t>(row / share)];
    });
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm_);
    std::vector<int> from, to;
    together([&] {
        from = begins_of(sent);
        to = begins_of(received);
        arrived.resize(static_cast<std::size_t>(to.back()) + static_cast<std::size_t>(received.back()));
        rows.resize(arrived.size() * columns);
        block.resize(static_cast<std::size_t>(count) * columns);
        if (static_cast<std::int64_t>(arrived.size()) != count)
            throw Trouble(DELAM_ERROR_INTERNAL, fmt::format("{}: {} rows of {} arrived from the parts", room.field.name,
                                                            arrived.size(), count));
    });
    const RowType row(columns);
    MPI_Alltoallv(mine.data(), sent.data(), from.data(), MPI_INT64_T, arrived.data(), received.data(), to.data(),
                  MPI_INT64_T, comm_);
    MPI_Alltoallv(values.values.data(), sent.data(), from.data(), row.get(), rows.data(), received.data(), to.data(),
                  row.get(), comm_);
    for (std::size_t i = 0; i < arrived.size(); ++i)
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * columns), columns,
                    block.begin() + (arrived[i] - first) * static_cast<std::ptrdiff_t>(columns));
    return block;
}

// ---- the result

void RankFields::copy(const std::string& path, const std::vector<FileRange>& ranges) {
    Telling telling(Job::copy);
    telling.put(path);
    telling.put(static_cast<std::int64_t>(ranges.size()));
    for (const FileRange& range : ranges) {
        telling.put(range.from);
        telling.put(range.offset);
        telling.put(range.bytes);
        telling.put(range.to);
    }
    everywhere(telling.bytes(), path);
}

// All ranges, one behind the other, are cut into as many pieces as there are ranks. Each rank reads and writes alone.
void RankFields::copy_ranges(Told& told) {
    together([&] {
        const std::string path = told.text();
        std::vector<FileRange> ranges(static_cast<std::size_t>(told.get<std::int64_t>()));
        std::int64_t total = 0;
        for (FileRange& range : ranges) {
            range.from = told.text();
            range.offset = told.get<std::int64_t>();
            range.bytes = told.get<std::int64_t>();
            range.to = told.get<std::int64_t>();
            total += range.bytes;
        }
        const std::int64_t share = (total + size_ - 1) / size_;
        copy_share(path, ranges, share * rank_, share * (rank_ + 1));
    });
}

}  // namespace cli
