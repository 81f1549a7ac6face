// SPDX-License-Identifier: BSD-3-Clause
// HDF5 reaches files through a driver of our own, which keeps the system's reason of the first operation that failed
// and does not let HDF5 see that writing failed. After a failed read or write, HDF5 1.10 crashes in some places,
// forgets the lost data in others, and never says why. The code that closes a file asks the driver instead.
//
// File driver interface: "HDF5 Virtual File Layer", HDF5 1.10 documentation; H5FDpublic.h.
#pragma once

#include <string>

#include <hdf5.h>

namespace cli::h5 {

struct FileTrouble {
    std::string path;
    int code = 0;  // errno; 0: none
};

// Begins with HDF5, once: it would print its stack of errors and, after a full disk, try to write again at exit; the
// program handles both itself.
void begin();
// The first operation that failed on this thread since the trouble was last taken.
FileTrouble take_trouble();
// True if there is memory for what HDF5 keeps of a file (half a megabyte): HDF5 1.10 ends by a signal where it gets
// none. The driver asks when it has opened a file, and then fails to open it.
bool memory_for_a_file();
// Properties of access with the driver. They live as long as the process.
hid_t driver_access();

}  // namespace cli::h5
