#pragma once

#include "cli/mesh_arguments.h"
#include "mpi/session.h"

namespace vcarve::mpi {

/// What every rank but the first does: shares of the run that `arguments` ask for, until rank 0
/// ends the program. Prints nothing; what goes wrong is told rank 0. While nothing is to be done it
/// leaves its core to others.
void follow(const Session& session, const cli::MeshArguments& arguments);

} // namespace vcarve::mpi
