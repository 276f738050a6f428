#pragma once

#include "cli/option_parser.h"
#include "cli/run_ranks.h"

namespace vcarve::cli {

/// `colmap-vcarve MODEL OUT.ply`. Throws UsageError and InputError; on success OUT.ply, and the
/// files of --stats and
/// --preview, are written whole. `ranks` are the other processes that work on it; null for none.
void run_mesh(const ParsedArguments& given, RunRanks* ranks = nullptr);

} // namespace vcarve::cli
