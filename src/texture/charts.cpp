#include "texture/charts.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "texture/face_photos.h"

#include <Eigen/Geometry>

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Array2i;
using Eigen::Vector2d;

/// Connected faces, and the size of the chart without padding.
struct Chart {
    std::vector<std::uint32_t> faces;
    Array2i size_px{0, 0};
};

constexpr int kTilePx = 5;      ///< side of the tile of a face without a photograph
constexpr int kTilesASide = 32; ///< tiles per row of a chart of such faces
constexpr std::size_t kTilesOfChart = std::size_t{kTilesASide} * kTilesASide;

/// The connected components of faces with the same photograph.
std::vector<Chart> gather_charts(const std::vector<std::uint32_t>& photo_of_face,
                                 const FacesBeside& beside)
{
    std::vector<Chart> charts;
    std::vector<std::uint8_t> is_taken(photo_of_face.size());
    const auto take = [&](std::uint32_t face, Chart& chart) {
        is_taken[face] = 1;
        chart.faces.push_back(face);
    };
    for (std::uint32_t first = 0; first < photo_of_face.size(); ++first) {
        if (is_taken[first] != 0 || photo_of_face[first] == kNoPhoto) continue;
        Chart chart;
        take(first, chart);
        for (std::size_t i = 0; i < chart.faces.size(); ++i) {
            for (const std::uint32_t other : beside[chart.faces[i]]) {
                const bool continues = other != kNoFace && is_taken[other] == 0 &&
                                       photo_of_face[other] == photo_of_face[first];
                if (continues) take(other, chart);
            }
        }
        charts.push_back(std::move(chart));
    }
    return charts;
}

/// Lays out the corners of a chart's faces as in the photograph, relative to the chart.
void place_in_chart(const TriMesh& mesh, const CalibratedPhoto& photo, const AtlasOptions& options,
                    Chart& chart, std::vector<std::array<Vector2d, 3>>& corners)
{
    Eigen::AlignedBox2d box;
    for (const std::uint32_t face : chart.faces) {
        corners[face] = *corner_pixels(photo, corners_of(mesh.positions, mesh.faces[face]));
        for (const Vector2d& corner : corners[face]) {
            box.extend(corner);
        }
    }
    // Start at a whole pixel, so that at scale 1 texel centers are pixel centers and nothing is
    // blurred.
    const Vector2d first = box.min().array().floor();
    const Vector2d sizes = box.max() - first;
    const int most_px = options.most_page_px - 2 * Atlas::kPadding - 1;
    const double scale = std::min(options.scale, most_px / std::max(sizes.maxCoeff(), 1.0));
    for (const std::uint32_t face : chart.faces) {
        for (Vector2d& corner : corners[face]) {
            corner = scale * (corner - first);
        }
    }
    chart.size_px = (scale * sizes.array()).ceil().cast<int>().max(1);
}

/// Makes charts of the faces without a photograph: tiles in rows.
std::vector<Chart> tile_unseen(const std::vector<std::uint32_t>& photo_of_face,
                               std::vector<std::array<Vector2d, 3>>& corners)
{
    std::vector<Chart> charts;
    for (std::uint32_t face = 0; face < photo_of_face.size(); ++face) {
        if (photo_of_face[face] != kNoPhoto) continue;
        if (charts.empty() || charts.back().faces.size() == kTilesOfChart) {
            charts.emplace_back();
        }
        Chart& chart = charts.back();
        const auto place = static_cast<int>(chart.faces.size());
        const Array2i tile(place % kTilesASide, place / kTilesASide);
        const Vector2d corner = (kTilePx * tile).cast<double>() + 1.0;
        corners[face] = {corner, corner + Vector2d(kTilePx - 2, 0),
                         corner + Vector2d(0, kTilePx - 2)};
        chart.faces.push_back(face);
        chart.size_px = chart.size_px.max(kTilePx * (tile + 1));
    }
    return charts;
}

std::vector<stbrp_rect> rectangles_of(const std::vector<Chart>& charts)
{
    std::vector<stbrp_rect> rectangles(charts.size());
    for (std::size_t i = 0; i < charts.size(); ++i) {
        rectangles[i].id = static_cast<int>(i);
        rectangles[i].w = charts[i].size_px.x() + 2 * Atlas::kPadding;
        rectangles[i].h = charts[i].size_px.y() + 2 * Atlas::kPadding;
    }
    return rectangles;
}

/// Packs as many rectangles as fit into a page. Returns whether all fit.
bool pack(int side_px, std::vector<stbrp_rect>& rectangles)
{
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(side_px));
    stbrp_context context;
    stbrp_init_target(&context, side_px, side_px, nodes.data(), side_px);
    return stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size())) == 1;
}

/// Packs rectangles into the smallest page that holds them all; page sides are multiples of 64. If
/// none does, packs as many as fit into the largest page.
void pack_page(int most_px, std::vector<stbrp_rect>& rectangles)
{
    double area = 0.0;
    int longest = 1;
    for (const stbrp_rect& rectangle : rectangles) {
        area += static_cast<double>(rectangle.w) * rectangle.h;
        longest = std::max({longest, rectangle.w, rectangle.h});
    }
    double side = std::max<double>(std::sqrt(area), longest);
    while (side < most_px) {
        std::vector<stbrp_rect> packed = rectangles;
        const int side_px = std::min(most_px, static_cast<int>(std::ceil(side / 64.0)) * 64);
        if (pack(side_px, packed)) {
            rectangles = std::move(packed);
            return;
        }
        side *= 1.06;
    }
    pack(most_px, rectangles);
}

/// Moves a chart to its position on the last page.
void put_on_page(const Chart& chart, const stbrp_rect& rectangle, Atlas& atlas)
{
    const Vector2d move(rectangle.x + Atlas::kPadding, rectangle.y + Atlas::kPadding);
    for (const std::uint32_t face : chart.faces) {
        atlas.page_of_face[face] = static_cast<std::uint32_t>(atlas.page_sizes.size() - 1);
        for (Vector2d& corner : atlas.corners[face]) {
            corner += move;
        }
    }
    Array2i& size = atlas.page_sizes.back();
    size = size.max(Array2i(rectangle.x + rectangle.w, rectangle.y + rectangle.h));
}

} // namespace

Atlas lay_out_charts(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                     const std::vector<std::uint32_t>& photo_of_face, const FacesBeside& beside,
                     const AtlasOptions& options)
{
    Atlas atlas;
    atlas.page_of_face.resize(mesh.faces.size());
    atlas.corners.resize(mesh.faces.size());
    std::vector<Chart> charts = gather_charts(photo_of_face, beside);
    parallel_for(
        charts.size(),
        [&](std::size_t i) {
            const std::uint32_t photo = photo_of_face[charts[i].faces.front()];
            place_in_chart(mesh, photos[photo], options, charts[i], atlas.corners);
        },
        16);
    atlas.num_charts = charts.size();
    for (Chart& chart : tile_unseen(photo_of_face, atlas.corners)) {
        charts.push_back(std::move(chart));
    }
    std::vector<stbrp_rect> rectangles = rectangles_of(charts);
    while (!rectangles.empty()) {
        pack_page(options.most_page_px, rectangles);
        atlas.page_sizes.emplace_back(1, 1);
        for (const stbrp_rect& rectangle : rectangles) {
            if (rectangle.was_packed != 0) put_on_page(charts[rectangle.id], rectangle, atlas);
        }
        std::erase_if(rectangles, [](const stbrp_rect& rect) { return rect.was_packed != 0; });
    }
    return atlas;
}

} // namespace vcarve
