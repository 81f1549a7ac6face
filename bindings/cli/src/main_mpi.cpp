// SPDX-License-Identifier: BSD-3-Clause
// The program `delam-mpi`: `delam` on many processes. Rank 0 reads the command line and the scene, and writes the
// results; the bodies are solved by all ranks together (delam/petsc.h).
#include <mpi.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include <dlfcn.h>

#include "blas_kernels.hpp"
#include "command/line/program.hpp"
#include "delam/petsc.h"
#include "file/descriptors.hpp"
#include "model/library/model.hpp"
#include "result/fields/rank_fields.hpp"
#include "text/error.hpp"
#include "text/say.hpp"

namespace {

constexpr const char* usage =
    "delam-mpi: as delam, on the processes of mpirun; see delam-mpi run --help.\n"
    "    mpirun -n 4 delam-mpi [--petsc OPTIONS] [--counts] [--divide] run SCENE.toml --out FOLDER\n"
    "  --petsc OPTIONS   options of PETSc for the bodies, e.g. \"-delam_pc_type bddc -delam_ksp_monitor\"; in front of "
    "the\n"
    "                    command, beside those of the variable PETSC_OPTIONS\n"
    "  --counts          prints at the end what the solves took; in front of the command\n"
    "  --divide          divides the mesh again, although Gmsh has partitioned it, so that cells on the two\n"
    "                    sides of an interface stay together; in front of the command. Without it a mesh with\n"
    "                    as many partitions as processes stays as it is\n"
    "Ctrl-C, or SIGTERM to rank 0 or mpirun, ends all ranks; finished steps are kept.\n";

// Ends with the program, on all ranks at once.
class Processes {
public:
    Processes(int& argc, char**& argv) {
        MPI_Init(&argc, &argv);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        // mpirun sends these to all ranks: rank 0 ends the run, and needs the others for that.
        if (!first()) {
            std::signal(SIGINT, SIG_IGN);
            std::signal(SIGTERM, SIG_IGN);
            std::signal(SIGXFSZ, SIG_IGN);  // a file too large gives an error code, as on rank 0
        }
    }
    ~Processes() { MPI_Finalize(); }
    Processes(const Processes&) = delete;
    Processes& operator=(const Processes&) = delete;
    bool first() const { return rank_ == 0; }
    static int shared(int value) {
        MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
        return value;
    }

private:
    int rank_ = 0;
};

// One thread of the BLAS for each process, unless its user says otherwise: as many processes as cores would each take
// all of them. (OpenBLAS reads the variable before main.)
void one_blas_thread() {
    if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr) return;
    if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<void (*)(int)>(set)(1);
}

// The next task of the other ranks: to solve cells that the library divides, or those of the partition that their mesh
// file has.
enum Next { leave, solve_divided, solve_partitions };

class Ranks {
public:
    Ranks(delam_petsc* petsc, bool divide) : petsc_(petsc), divide_(divide) {}

    // Rank 0 gives the bodies to all ranks, which then serve `rest`.
    int around(const cli::Model& model, const std::function<int()>& rest) {
        const std::vector<std::int32_t> rank = ranks_of(model);
        (void)Processes::shared(rank.empty() ? solve_divided : solve_partitions);
        call(rank.empty() ? delam_petsc_take_scene(petsc_, model.mesh.get(), model.problem.get())
                          : delam_petsc_take_cells(petsc_, model.mesh.get(), model.problem.get(),
                                                   static_cast<std::int64_t>(rank.size()), rank.data()),
             model);
        call(delam_petsc_attach(petsc_, model.problem.get()), model);
        Work work{rest, cli::exit_numerical, {}};
        const std::int32_t status = delam_petsc_run(petsc_, run, &work);
        if (work.failure) std::rethrow_exception(work.failure);
        call(status, model);
        return work.code;
    }
    // The other ranks serve until rank 0 has come to its end.
    void serve() {
        for (int next = Processes::shared(leave); next != leave; next = Processes::shared(leave)) {
            const std::int32_t taken = next == solve_divided
                                           ? delam_petsc_take_scene(petsc_, nullptr, nullptr)
                                           : delam_petsc_take_cells(petsc_, nullptr, nullptr, 0, nullptr);
            if (taken != DELAM_OK) continue;
            if (delam_petsc_attach(petsc_, nullptr) != DELAM_OK) continue;
            (void)delam_petsc_run(petsc_, nullptr, nullptr);
        }
    }

private:
    struct Work {
        const std::function<int()>& rest;
        int code;
        std::exception_ptr failure;
    };
    // The rank of each cell by the mesh file's partitions, if there are as many as ranks; else empty. Says which of
    // both.
    std::vector<std::int32_t> ranks_of(const cli::Model& model) const {
        std::vector<std::int32_t> rank = model.partitions;
        if (rank.empty() || divide_) return {};
        int ranks = 1;
        MPI_Comm_size(MPI_COMM_WORLD, &ranks);
        const std::int32_t partitions = *std::max_element(rank.begin(), rank.end());
        if (partitions != ranks) {
            cli::say("bodies: divided anew, because the mesh file has {} partitions, and there are {} ranks\n",
                     partitions, ranks);
            return {};
        }
        for (std::int32_t& r : rank) --r;
        cli::say("bodies: each of the {} ranks has a partition of the mesh file\n", ranks);
        return rank;
    }
    static std::int32_t run(void* user) {
        auto& work = *static_cast<Work*>(user);
        try {
            work.code = work.rest();
        } catch (...) {
            work.failure = std::current_exception();
        }
        return DELAM_OK;
    }
    void call(std::int32_t status, const cli::Model& model) const {
        if (status == DELAM_OK) return;
        const std::string said = delam_petsc_message(petsc_), own = delam_context_message(model.context.get());
        throw cli::Failure(
            status == DELAM_ERROR_PROBLEM || status == DELAM_ERROR_ARGUMENT ? cli::exit_scene : cli::exit_numerical,
            said.empty() ? own : said);
    }
    delam_petsc* petsc_;
    bool divide_;  // in spite of the mesh file's partitions
};

void drop_words(int& argc, char** argv, int count) {
    for (int i = 1 + count; i <= argc; ++i) argv[i - count] = argv[i];
    argc -= count;
}

// Takes the options of this program out of the words, and puts those of PETSc behind those of the environment. False:
// OPTIONS are missing.
bool take_options(int& argc, char** argv, bool& counts, bool& divide) {
    while (argc > 1) {
        if (std::strcmp(argv[1], "--counts") == 0) {
            counts = true;
            drop_words(argc, argv, 1);
        } else if (std::strcmp(argv[1], "--divide") == 0) {
            divide = true;
            drop_words(argc, argv, 1);
        } else if (std::strcmp(argv[1], "--petsc") == 0) {
            if (argc < 3) return false;
            const char* before = std::getenv("PETSC_OPTIONS");
            const std::string all = (before != nullptr ? std::string(before) + " " : std::string()) + argv[2];
            setenv("PETSC_OPTIONS", all.c_str(), 1);
            drop_words(argc, argv, 2);
        } else {
            break;
        }
    }
    return true;
}

// Prints the counts; all ranks call it.
void say_counts(const Processes& processes, delam_petsc* petsc) {
    std::string line = "counts:";
    for (const char* key :
         {"solves", "iterations", "renewals", "factor_entries", "factor_flops", "memory_mb_max", "memory_mb_sum",
          "operations_max", "operations_sum", "bytes_sent_max", "bytes_sent_sum", "messages_max", "messages_sum"}) {
        double value = 0.0;
        if (delam_petsc_value(petsc, key, &value) == DELAM_OK) line += fmt::format(" {} {:.10g}", key, value);
    }
    if (processes.first()) cli::say("{}\n", line);
}

int on_all_ranks(const Processes& processes, int argc, char** argv) {
    bool counts = false, divide = false;
    const bool right = take_options(argc, argv, counts, divide) && argc > 1;
    const bool help = right && std::strcmp(argv[1], "--help") == 0;
    if (!right || help) {
        if (processes.first() && help) cli::say("{}", usage);
        if (processes.first() && !help) cli::complain("{}", usage);
        return help ? cli::exit_done : cli::exit_scene;
    }
    delam_petsc* petsc = nullptr;
    if (delam_petsc_create(MPI_COMM_WORLD, &petsc) != DELAM_OK) {
        if (processes.first()) cli::complain("delam-mpi: PETSc cannot be initialised\n");
        return cli::exit_numerical;
    }
    int code = cli::exit_done;
    Ranks ranks(petsc, divide);
    cli::RankFields fields(petsc);
    if (processes.first()) {
        const auto around = [&](const cli::Model& model, const std::function<int()>& rest) {
            return ranks.around(model, rest);
        };
        code = cli::program(argc, argv, {"mpirun delam-mpi", around, &fields});
        (void)Processes::shared(leave);
    } else {
        ranks.serve();
    }
    if (counts) say_counts(processes, petsc);
    delam_petsc_destroy(&petsc);
    return code;  // rank 0's is that of mpirun
}

}  // namespace

int main(int argc, char** argv) {
    cli::choose_blas_kernels(argv);
    cli::open_standard_descriptors();
    one_blas_thread();
    const Processes processes(argc, argv);
    return on_all_ranks(processes, argc, argv);
}
