#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// How often values fall between which bounds.
struct Histogram {
    std::vector<double> bounds;       ///< ascending, one more than counts
    std::vector<std::int64_t> counts; ///< of values from a bound up to the next, that excluded
    std::int64_t values = 0;          ///< in all: those of the counts, and `beyond`
    std::int64_t beyond = 0;          ///< how many lie at the last bound or above it
    double median = 0.0;              ///< of all values, the upper one of two; 0 of none
    double largest = 0.0;             ///< of all values; 0 of none
};

/// Whole numbers one by one, from the smallest to at most `bins` above; those beyond, which long
/// tails have, are counted together.
Histogram histogram_of_counts(std::vector<std::int64_t> values, int bins);

/// Values from 0 up to about their 99th percentile, in `bins` steps that are equal and round (1, 2
/// or 5 times a power of ten), fewer where that does; those beyond are counted together. Values
/// must be finite and not negative.
Histogram histogram_of_lengths(std::vector<double> values, int bins);

/// What a report says of a surface beyond what a check counts.
struct SurfaceFigures {
    std::int64_t faces = 0;
    std::int64_t unsupported_faces = 0; ///< those with support 0, see Provenance::supports
    double unsupported_area = 0.0;      ///< their share of the area
    double long_area = 0.0;  ///< share of the area in faces with an edge over kLong median edges
    Histogram edge_lengths;  ///< in scene units, every edge of every face
    Histogram track_lengths; ///< views, of the measured points the surface was made from
    Histogram errors_px;     ///< of those points, where it is known
    std::int64_t points = 0; ///< measured ones that the surface was made from
    static constexpr double kLong = 10.0;
};

/// `supports` are those of the faces. Cost: O(faces + points).
SurfaceFigures surface_figures(const TriMesh& mesh, std::span<const std::int32_t> supports,
                               const Scene& scene);

/// "unsupported_faces", "unsupported_area", "long_area", "histograms".
nlohmann::ordered_json figures_json(const SurfaceFigures& figures);

/// What a person should know before trusting the surface, in plain sentences made of figures, in
/// the order of the run. `record` is the run's, with "stages"; of what it lacks nothing is said.
std::vector<std::string> warnings_of(const SurfaceFigures& figures,
                                     const nlohmann::ordered_json& record);

} // namespace vcarve
