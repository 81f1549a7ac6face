# SPDX-License-Identifier: BSD-3-Clause
# Finds and loads libdelam, in this order:
#
# 1. the environment variable DELAM_LIBRARY, a file or a folder; if it is set, nothing else is tried
# 2. the loader's paths: LD_LIBRARY_PATH, ldconfig
# 3. pkg-config's libdir of delam
#
# The raw layer calls the library by its SONAME. A library loaded by its full path is found under that name.

const VARIABLE = "DELAM_LIBRARY"
const loaded_from = Ref("")

in_folder(folder) = joinpath(folder, Raw.libdelam)

function candidates()
    given = get(ENV, VARIABLE, "")
    isempty(given) || return [(isdir(given) ? in_folder(given) : given, VARIABLE)]
    found = [(Raw.libdelam, "the loader's paths")]
    folder = try
        readchomp(pipeline(`pkg-config --variable=libdir delam`; stderr=devnull))
    catch
        ""
    end
    isempty(folder) || push!(found, (in_folder(folder), "pkg-config"))
    return found
end

function load_library()
    tried = String[]
    for (path, place) in candidates()
        handle = dlopen(path; throw_error=false)
        if handle === nothing
            push!(tried, "$place: $path")
            continue
        end
        refuse_another(handle, path)
        loaded_from[] = path
        return
    end
    error("libdelam was not found. Set $VARIABLE to $(Raw.libdelam) or to its folder, or install it where the loader " *
          "looks. Tried:\n  " * join(tried, "\n  "))
end

"Another ABI, or a library that is older than this package."
function refuse_another(handle, path)
    dlopen(Raw.libdelam; throw_error=false) == handle ||
        error("$path does not answer to $(Raw.libdelam), which this package needs: install matching versions")
    missed = [name for name in Raw.FUNCTIONS if dlsym(handle, name; throw_error=false) === nothing]
    isempty(missed) || error("$path lacks $(join(missed, ", ")): it is older than this package")
    abi = Raw.delam_abi()
    abi == Raw.DELAM_ABI || error("$path has ABI $abi, this package needs $(Raw.DELAM_ABI): install matching versions")
    return
end

"Version of the libdelam that was loaded."
library_version() = unsafe_string(Raw.delam_version())

"Commit that it was built from, or \"unknown\"."
library_commit() = unsafe_string(Raw.delam_commit())

"Threads that the BLAS of this process uses; 0: unknown. Not those of Julia's own."
blas_threads() = Int(Raw.delam_blas_threads())

"File that it was loaded from, as passed to the loader."
library_location() = loaded_from[]
