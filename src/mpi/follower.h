#pragma once

#include "cli/mesh_arguments.h"
#include "mpi/session.h"

#include <functional>

namespace vcarve::mpi {

/// Reads the command line; throws UsageError.
using ReadArguments = std::function<cli::MeshArguments()>;

/// Runs a rank other than rank 0: does its shares of the run until rank 0 ends the program. Prints
/// nothing. Reports errors to rank 0, also if its options differ from those of rank 0. Sleeps while
/// it has no work.
void follow(const Session& session, const ReadArguments& read);

} // namespace vcarve::mpi
