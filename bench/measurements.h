#pragma once

#include "processes.h"
#include "sample_scene.h"

#include <cstddef>
#include <filesystem>

namespace vcarve::bench {

/// A model or dense workspace on disk, and a folder for intermediate files and output.
struct Sample {
    std::filesystem::path model;
    std::filesystem::path scratch;

    /// The file of the points that a run triangulates: raw doubles, the input of CGAL.
    std::filesystem::path triangulated() const { return scratch / "triangulated.raw"; }
};

/// Writes a model of a sampled surface, unless its folder exists.
void make_model(const std::filesystem::path& folder, const SampleKind& kind, std::size_t points);

/// Runs once and writes the file of triangulated points. Returns {"model", "points",
/// "triangulated", "views", "rays"}.
Json prepare(const Sample& sample);

/// Measurements: {"seconds", "cpu_seconds", "peak_bytes", "stages": [{"name", "seconds",
/// "cpu_seconds", "peak_bytes"}]}. Call each in a new process. Peaks are above the memory of the
/// process at the start of the measurement.

/// Measures CGAL's triangulation alone, with points in memory.
Json measure_sequential_triangulation(const Sample& sample);
Json measure_parallel_triangulation(const Sample& sample, int threads);

/// Measures a run of the program, from the files of the model to the file of the surface. Adds
/// "base_bytes", the memory before the run, and "predicted_bytes", the predicted peak of the
/// process. Stages with a prediction also have "predicted_bytes".
Json measure_run(const Sample& sample, int threads);

} // namespace vcarve::bench
