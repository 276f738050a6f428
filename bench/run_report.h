#pragma once

#include "processes.h"

#include <map>
#include <string>
#include <vector>

namespace vcarve::bench {

/// The measurements on one sample: medians over the rounds.
struct SampleResult {
    Json sizes;                   ///< from prepare()
    Json sequential;              ///< CGAL's triangulation
    Json peer;                    ///< another program's whole run, or null
    std::map<int, Json> parallel; ///< by thread count, from 2 on
    std::map<int, Json> runs;     ///< by thread count
};

/// The median of each figure over repeated measurements; the upper one of an even number.
Json median_of(const std::vector<Json>& measurements);

/// A Markdown table with the ratios to CGAL's triangulation, and of predicted to measured memory.
/// Warns if a prediction is not as exact as pipeline/memory.h promises.
std::string report(const SampleResult& result);

/// A Markdown table with a row per sample: the time of its run on most threads, and the parts of
/// added points, triangulation, rays, cut and surface, relative to CGAL's triangulation and
/// another program.
std::string summary(const std::vector<SampleResult>& results);

/// All figures.
Json json_of(const SampleResult& result);

} // namespace vcarve::bench
