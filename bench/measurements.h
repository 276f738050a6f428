#pragma once

#include "processes.h"
#include "sample_scene.h"

#include <cstddef>
#include <filesystem>

namespace vcarve::bench {

/// A model or dense workspace on disk, and where what is made of it goes.
struct Sample {
    std::filesystem::path model;
    std::filesystem::path scratch;

    /// The points that a run triangulates, as CGAL gets them: raw doubles.
    std::filesystem::path triangulated() const { return scratch / "triangulated.raw"; }
};

/// Writes a model of a sampled surface, unless its folder is there.
void make_model(const std::filesystem::path& folder, const SampleKind& kind, std::size_t points);

/// Runs once and writes the file of triangulated points. Returns {"model", "points",
/// "triangulated", "views", "sights"}.
Json prepare(const Sample& sample);

/// Measurements, to be called in a process of their own: {"seconds", "cpu_seconds", "peak_bytes",
/// "stages": [{"name", "seconds", "cpu_seconds", "peak_bytes"}]}. Peaks are above what the process
/// held when the measurement began.

/// CGAL's triangulation alone, its points already in memory.
Json measure_sequential_triangulation(const Sample& sample);
Json measure_parallel_triangulation(const Sample& sample, int threads);

/// From the files of the model to the file of the surface, as the program does it; with
/// "base_bytes", what the process held before, and "predicted_bytes", the peak of the process
/// foretold; the latter also for every stage that has a prediction.
Json measure_run(const Sample& sample, int threads);

} // namespace vcarve::bench
