#pragma once

#include "cli/manual.h"
#include "cli/option_parser.h"

namespace vcarve::cli {

/// The bare form, `colmap-vcarve MODEL OUT.ply`: a surface from a model.
Manual mesh_manual();

/// Throws UsageError and InputError; on success OUT.ply, and the files of --stats and
/// --preview, are written whole.
void run_mesh(const ParsedArguments& given);

} // namespace vcarve::cli
