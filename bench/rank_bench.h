#pragma once

#include "forked.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {

/// A model for so many ranks.
struct RankModel {
    std::filesystem::path folder;
    std::size_t points = 0;
    std::size_t ranks = 1;
};

/// How they are run.
struct RankRuns {
    std::filesystem::path program;      ///< for one process
    std::filesystem::path rank_program; ///< for ranks, started by `launcher`
    std::filesystem::path launcher = "mpirun";
    std::filesystem::path folder; ///< for surfaces and the work folder
    std::size_t rounds = 1;
};

/// What one model took.
struct RankRun {
    RankModel model;
    Json figures;        ///< of all ranks, of measure_program(), medians over the rounds
    Json alone;          ///< the same of one process, in memory
    bool is_same = true; ///< the surfaces of all rounds, byte by byte
};

/// Runs each model on its ranks, with one thread each and a work folder, and on one process with
/// one thread, in memory. Runs go over all in turn, so that what disturbs the machine disturbs all
/// alike.
std::vector<RankRun> measure_ranks(const std::vector<RankModel>& models, const RankRuns& runs);

/// A table in Markdown with a row a model. The efficiency is that of weak scaling against the first
/// row: of CPU seconds a point, and of elapsed seconds a point of a rank.
std::string rank_report(const std::string& title, const std::vector<RankRun>& runs);

/// Whether all surfaces had the same bytes as those of one process.
bool is_same_everywhere(const std::vector<RankRun>& runs);

/// All figures.
Json json_of(const std::vector<RankRun>& runs);

} // namespace vcarve::bench
