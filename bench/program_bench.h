#pragma once

#include "processes.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {

/// The measured programs. Each round runs all of them in turn, so other load on the machine affects
/// all equally.
struct Programs {
    std::filesystem::path program;
    std::filesystem::path rank_program; ///< for ranks, started by mpirun
    std::filesystem::path folder;       ///< for surfaces and the work folder
    std::size_t rounds = 1;
};

struct ProgramReport {
    std::string table;   ///< in Markdown, one row per run
    Json figures;        ///< medians over the rounds
    bool is_same = true; ///< whether the surfaces of all rounds are byte-identical
};

/// Runs a model with each value of --blocks and each thread count. Compares seconds and memory with
/// the run in memory (--blocks 0), if `blocks` has it. All surfaces must equal that of the first
/// run.
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
/// one thread, in memory. Reports the efficiency of weak scaling relative to the first model: in
/// CPU seconds per point, and in elapsed seconds per point of a rank.
ProgramReport compare_ranks(const std::string& title, const std::vector<RankModel>& models,
                            const Programs& programs);

} // namespace vcarve::bench
