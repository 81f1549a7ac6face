// SPDX-License-Identifier: BSD-3-Clause
// The limits of control groups, read from trees of files as Linux shows them.
#include "base/memory_limit.hpp"
#include "check.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

using namespace delam;

namespace {

// A folder with /proc/self/cgroup and files below /sys/fs/cgroup.
class Tree {
public:
    explicit Tree(const std::string& groups) : top_(make_folder()) { write("/proc/self/cgroup", groups); }
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { std::filesystem::remove_all(top_); }
    Tree& set(const std::string& file, const std::string& text) {
        write("/sys/fs/cgroup" + file, text);
        return *this;
    }
    double limit() const { return control_group_limit(top_); }

private:
    static std::string make_folder() {
        std::string name = (std::filesystem::temp_directory_path() / "delam_groups_XXXXXX").string();
        ck_assert_ptr_nonnull(mkdtemp(name.data()));
        return name;
    }
    void write(const std::string& file, const std::string& text) const {
        const std::filesystem::path path = top_ + file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    std::string top_;
};

}  // namespace

TEST(no_groups_no_limit) {
    ck_assert(std::isinf(control_group_limit("/no such folder")));
    ck_assert(std::isinf(Tree("0::/\n").limit()));
    ck_assert(std::isinf(Tree("0::/job\n").set("/job/memory.max", "max\n").limit()));
}

// Groups of version 2: the group itself, one around it, and the root of a container, which is its own group.
TEST(the_narrowest_group_decides) {
    Tree tree("0::/batch/job.slice/step\n");
    tree.set("/batch/job.slice/step/memory.max", "8589934592\n");
    ck_assert_double_eq(tree.limit(), 8589934592.0);
    tree.set("/batch/job.slice/memory.max", "4294967296\n").set("/batch/memory.max", "max\n");
    ck_assert_double_eq(tree.limit(), 4294967296.0);
    // Its neighbours are not asked.
    tree.set("/batch/other/memory.max", "1048576\n").set("/batch/job/memory.max", "1048576\n");
    ck_assert_double_eq(tree.limit(), 4294967296.0);
    tree.set("/memory.max", "2147483648\n");
    ck_assert_double_eq(tree.limit(), 2147483648.0);
}

// The controller of version 1 counts; paths may contain colons, and other controllers have trees of their own.
TEST(version_1) {
    Tree tree("12:cpu,cpuacct:/a\n7:memory,hugetlb:/docker/id:7\n1:name=systemd:/a\n0::/\n");
    ck_assert(std::isinf(tree.limit()));
    tree.set("/memory/docker/id:7/memory.limit_in_bytes", "3221225472\n");
    ck_assert_double_eq(tree.limit(), 3221225472.0);
    tree.set("/memory/a/memory.limit_in_bytes", "1048576\n");
    ck_assert_double_eq(tree.limit(), 3221225472.0);
    tree.set("/memory/memory.limit_in_bytes", "1073741824\n");
    ck_assert_double_eq(tree.limit(), 1073741824.0);
}

TEST(lines_that_mean_nothing) {
    Tree tree("\nnonsense\n0:\n0::no path\n0::/a/../b\n5:memory:\n");
    ck_assert(std::isinf(tree.limit()));
    tree.set("/memory.max", "not a number\n");
    ck_assert(std::isinf(tree.limit()));
}
