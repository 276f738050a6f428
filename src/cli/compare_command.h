#pragma once

#include "cli/manual.h"
#include "cli/option_parser.h"

namespace vcarve::cli {

/// `colmap-vcarve compare MODEL A.ply ...`: a table of figures, a column a mesh, on stdout.
Manual compare_manual();

/// Throws UsageError and InputError; on success the table is printed, and the files of --json and
/// --preview are written whole.
void run_compare(const ParsedArguments& given);

} // namespace vcarve::cli
