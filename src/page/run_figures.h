#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A histogram of values.
struct Histogram {
    std::vector<double> bounds;       ///< ascending, one more than `counts`
    std::vector<std::int64_t> counts; ///< number of values in [bound, next bound)
    std::int64_t values = 0;          ///< total: sum of `counts`, and `beyond`
    std::int64_t beyond = 0;          ///< number of values at or above the last bound
    double median = 0.0;              ///< of all values, the upper of two; 0 if none
    double largest = 0.0;             ///< of all values; 0 if none
};

/// Counts integers in bins of size 1, from the smallest value on, in at most `bins` bins. Larger
/// values (long tails) are counted in `beyond`.
Histogram histogram_of_counts(std::vector<std::int64_t> values, int bins);

/// Counts values from 0 to about their 99th percentile in `bins` or fewer bins of equal, round size
/// (1, 2 or 5 times a power of ten). Larger values are counted in `beyond`. Precondition: values
/// are finite and not negative.
Histogram histogram_of_lengths(std::vector<double> values, int bins);

/// Figures of a report that check_mesh() does not count.
struct SurfaceFigures {
    std::int64_t faces = 0;
    std::int64_t unsupported_faces = 0; ///< faces with support 0, see Provenance::supports
    double unsupported_area = 0.0;      ///< their fraction of the area
    double long_area = 0.0;             ///< area fraction of faces with an edge above kLong medians
    Histogram edge_lengths;             ///< in scene units, of every edge of every face
    Histogram track_lengths;            ///< number of views of each measured point
    Histogram errors_px;                ///< of measured points, if known
    std::int64_t points = 0;            ///< measured points that the surface was made from
    static constexpr double kLong = 10.0;
};

/// `supports` has one entry per face. Cost: O(faces + points).
SurfaceFigures surface_figures(const TriMesh& mesh, std::span<const std::int32_t> supports,
                               const Scene& scene);

/// Returns "points", "unsupported_faces", "unsupported_area", "long_area" and "histograms".
nlohmann::ordered_json figures_json(const SurfaceFigures& figures);

/// Returns warnings about the quality of the surface: sentences, in the order of the run. `record`
/// is the run's, with "stages"; missing entries cause no warnings.
std::vector<std::string> warnings_of(const SurfaceFigures& figures,
                                     const nlohmann::ordered_json& record);

} // namespace vcarve
