#pragma once

#include "processes.h"

#include <map>
#include <string>
#include <vector>

namespace vcarve::bench {

/// What was measured on one sample, medians over the rounds.
struct SampleResult {
    Json sizes;                   ///< as prepare() has it
    Json sequential;              ///< CGAL's triangulation
    Json peer;                    ///< another program's whole run; null where none was given
    std::map<int, Json> parallel; ///< by the number of threads, from two on
    std::map<int, Json> runs;     ///< by the number of threads
};

/// The middle of each figure of some measurements of the same thing; of an even number the upper.
Json median_of(const std::vector<Json>& measurements);

/// A table in Markdown, with the ratios to CGAL's triangulation and of predicted to measured
/// memory; warns of runs whose memory was not foretold as pipeline_memory.h says.
std::string report(const SampleResult& result);

/// A table in Markdown with a row for each sample: what its run on most threads took, and how much
/// of it added points, the triangulation, the sights, the cut and the surface, against CGAL's
/// triangulation and another program.
std::string summary(const std::vector<SampleResult>& results);

/// All figures.
Json json_of(const SampleResult& result);

} // namespace vcarve::bench
