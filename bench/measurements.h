#pragma once

#include "forked.h"
#include "sample_scene.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace vcarve::bench {

/// A sample model on disk, and the points of it that are triangulated.
struct Sample {
    Shape shape = Shape::surface;
    std::size_t points = 0;
    std::filesystem::path folder; ///< of the model

    /// The points that pass the filter, as the triangulation gets them: raw doubles.
    std::filesystem::path triangulated() const { return folder / "triangulated.raw"; }
};

/// Makes the model, unless it is there, and the file of its triangulated points. Returns
/// {"shape", "points", "triangulated", "views", "sights"}.
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
