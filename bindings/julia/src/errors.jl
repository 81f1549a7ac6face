# SPDX-License-Identifier: BSD-3-Clause

"""
    DelamError{status}

An error of the library (status < 0), which leaves the object as it was, or an outcome (status > 0), which leaves it
valid. Each status has a name: `InvalidArgument`, `InvalidHandle`, `MeshError`, `ProblemError`, `StateError`,
`OutOfMemory`, `NumericalError`, `SnapshotError`, `FileError`, `InternalError`; `NotConverged`, `Cancelled`,
`LimitReached`. The text is in `message`.
"""
struct DelamError{status} <: Exception
    message::String
end

DelamError(status, message) = DelamError{status}(message)

const InvalidArgument = DelamError{Raw.DELAM_ERROR_ARGUMENT}
const InvalidHandle = DelamError{Raw.DELAM_ERROR_HANDLE}
const MeshError = DelamError{Raw.DELAM_ERROR_MESH}
const ProblemError = DelamError{Raw.DELAM_ERROR_PROBLEM}
const StateError = DelamError{Raw.DELAM_ERROR_STATE}
const OutOfMemory = DelamError{Raw.DELAM_ERROR_MEMORY}
const NumericalError = DelamError{Raw.DELAM_ERROR_NUMERICAL}
const SnapshotError = DelamError{Raw.DELAM_ERROR_SNAPSHOT}
const FileError = DelamError{Raw.DELAM_ERROR_FILE}
const InternalError = DelamError{Raw.DELAM_ERROR_INTERNAL}
const NotConverged = DelamError{Raw.DELAM_NOT_CONVERGED}
const Cancelled = DelamError{Raw.DELAM_CANCELLED}
const LimitReached = DelamError{Raw.DELAM_LIMIT}

status_name(status) = unsafe_string(Raw.delam_status_name(status))

Base.showerror(io::IO, error::DelamError{status}) where {status} = print(io, status_name(status), ": ", error.message)
