#pragma once

#include "forked.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {

/// Runs of the program to be measured against each other.
struct BlockRuns {
    std::filesystem::path program;
    std::filesystem::path folder;    ///< for surfaces and what is put aside in blocks
    std::vector<std::string> blocks; ///< words for --blocks
    std::vector<int> threads;
    std::size_t rounds = 1;
    bool in_memory = true; ///< run with --blocks 0 as well, and compare the surfaces with its own
};

/// What one run took.
struct BlockRun {
    std::string blocks; ///< "0": in memory
    int threads = 1;
    Json figures; ///< of measure_program(), medians over the rounds
    enum class Surface { same, other, unknown } surface = Surface::unknown; ///< beside the first
};

/// What was measured on one model.
struct BlockResult {
    std::string model;
    std::size_t points = 0; ///< 0 where that is not known before it is read
    std::vector<BlockRun> runs;
};

/// Runs go over all in turn, `rounds` times, so that what disturbs the machine disturbs all alike.
/// The surface of each is compared with that of the first, byte by byte.
BlockResult measure_blocks(const std::filesystem::path& model, const BlockRuns& runs);

/// A table in Markdown with a row a run, beside the run in memory on as many threads.
std::string block_report(const BlockResult& result);

/// Whether all surfaces had the same bytes.
bool is_same_everywhere(const BlockResult& result);

/// All figures.
Json json_of(const BlockResult& result);

} // namespace vcarve::bench
