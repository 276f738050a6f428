#pragma once

#include "cli/mesh_arguments.h"
#include "run/work_folder.h"
#include "vcarve/log.h"
#include "vcarve/options.h"

#include <memory>

namespace vcarve::cli {

/// Opens the folder of --work and begins its job. Returns null without --work. Throws InputError if
/// another run uses it and does not share tiles. Cost: the digest of all inputs.
std::unique_ptr<WorkFolder> open_work(const MeshArguments& arguments, Log& log);

/// The options of a run in tiles: the memory limit applies to each of them.
Options options_of_tiles(const MeshArguments& arguments);

/// Shares the tiles of another process with the same command. Returns whether that made the mesh.
bool has_helped(const MeshArguments& arguments, WorkFolder& work, Log& log);

} // namespace vcarve::cli
