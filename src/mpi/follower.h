#pragma once

#include "cli/mesh_arguments.h"
#include "mpi/session.h"

#include <functional>

namespace vcarve::mpi {

/// Reads the command line; throws UsageError.
using ReadArguments = std::function<cli::MeshArguments()>;

/// What every rank but the first does: shares of the run that its command line asks for, until rank
/// 0 ends the program. Prints nothing; what goes wrong is told rank 0, and that it was started with
/// other options than rank 0. While nothing is to be done it leaves its core to others.
void follow(const Session& session, const cli::Processes& processes, const ReadArguments& read);

} // namespace vcarve::mpi
