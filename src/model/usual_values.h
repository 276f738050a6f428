#pragma once

#include <optional>

namespace vcarve {

/// Medians of a model to which thresholds are relative. A run in memory measures them in its own
/// points. The tiles of a model (tiles/) all use those of the whole model, since their surfaces
/// would not meet otherwise.
struct UsualValues {
    std::optional<double> isolation;      ///< of points (stray_points.h)
    std::optional<double> error_px;       ///< known reprojection error
    std::optional<double> large_error_px; ///< one in twenty is larger
    std::optional<double> noise_px;       ///< of a cloud, with few neighbors (denoise.h)
    std::optional<double> wide_noise_px;  ///< the same with many neighbors
    std::optional<double> noise_spacings; ///< the noise in point spacings, as the former
    std::optional<double> wide_noise_spacings;
    std::optional<double> bend;       ///< of a cloud's surface (planar_regions.h)
    std::optional<double> short_edge; ///< see Scales
    std::optional<double> median_error_px;
    std::optional<double> median_views;
    std::optional<double> radius;            ///< of the region of interest
    std::optional<double> face_length;       ///< longest edge of kept faces
    std::optional<double> vertex_noise_px;   ///< of a sparse model (refine.h)
    std::optional<double> vertex_spacing;    ///< of the surface of a cloud
    std::optional<double> points_of_witness; ///< points that a PointKind::witness represents
};

/// All fields, for code that treats them alike.
inline constexpr std::optional<double> UsualValues::*kUsualValues[] = {
    &UsualValues::isolation,           &UsualValues::error_px,
    &UsualValues::large_error_px,      &UsualValues::noise_px,
    &UsualValues::wide_noise_px,       &UsualValues::noise_spacings,
    &UsualValues::wide_noise_spacings, &UsualValues::bend,
    &UsualValues::short_edge,          &UsualValues::median_error_px,
    &UsualValues::median_views,        &UsualValues::radius,
    &UsualValues::face_length,         &UsualValues::vertex_noise_px,
    &UsualValues::vertex_spacing,      &UsualValues::points_of_witness};

/// Returns the known value, or measures it and makes it known. Without `values` it always measures.
template <typename Measure>
double usual_value(UsualValues* values, std::optional<double> UsualValues::*which,
                   const Measure& measure)
{
    if (values == nullptr) return measure();
    std::optional<double>& value = values->*which;
    if (!value) value = measure();
    return *value;
}

} // namespace vcarve
