#pragma once

#include "processes.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {

/// The programs that are measured. Runs go over all in turn, so that what disturbs the machine
/// disturbs all alike.
struct Programs {
    std::filesystem::path program;
    std::filesystem::path rank_program; ///< for ranks, started by mpirun
    std::filesystem::path folder;       ///< for surfaces and the work folder
    std::size_t rounds = 1;
};

struct ProgramReport {
    std::string table;   ///< in Markdown, a row per run
    Json figures;        ///< all of them, medians over the rounds
    bool is_same = true; ///< whether the surfaces of all rounds have the same bytes
};

/// Runs a model with each word for --blocks on each number of threads, and compares seconds and
/// memory with the run in memory, --blocks 0, if there is one. The surfaces must be that of the
/// first run.
ProgramReport compare_blocks(const std::filesystem::path& model,
                             const std::vector<std::string>& blocks,
                             const std::vector<int>& threads, const Programs& programs);

/// A model for this number of ranks.
struct RankModel {
    std::filesystem::path folder;
    std::size_t points = 0;
    std::size_t ranks = 1;
};

/// Runs each model on its ranks, with one thread each and a work folder, and on one process with
/// one thread, in memory. The efficiency is that of weak scaling against the first model: of CPU
/// seconds per point, and of elapsed seconds per point of a rank.
ProgramReport compare_ranks(const std::string& title, const std::vector<RankModel>& models,
                            const Programs& programs);

} // namespace vcarve::bench
