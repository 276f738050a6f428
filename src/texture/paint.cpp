#include "texture/paint.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "model/colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Array3f;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A texel belongs to the face that contains its center, or to a face at most this far away.
constexpr double kBeyondPx = 0.75;

/// Barycentric coordinates in a triangle of the plane.
class Shares {
  public:
    explicit Shares(const std::array<Vector2d, 3>& corners)
        : corner_(corners[0]),
          to_second_(corners[1] - corners[0]),
          to_third_(corners[2] - corners[0]),
          determinant_(to_second_.x() * to_third_.y() - to_second_.y() * to_third_.x())
    {
        const std::array<Vector2d, 3> opposite = {corners[2] - corners[1], to_third_, to_second_};
        for (int i = 0; i < 3; ++i) {
            a_pixel_[i] = opposite[i].norm() / std::max(std::abs(determinant_), 1e-12);
        }
    }

    Vector3d at(const Vector2d& place) const
    {
        if (std::abs(determinant_) < 1e-12) return Vector3d::Constant(1.0 / 3.0);
        const Vector2d way = place - corner_;
        const double second = (way.x() * to_third_.y() - way.y() * to_third_.x()) / determinant_;
        const double third = (to_second_.x() * way.y() - to_second_.y() * way.x()) / determinant_;
        return {1.0 - second - third, second, third};
    }

    /// The approximate distance of a position with these coordinates from the triangle.
    double beyond(const Vector3d& shares) const
    {
        double most = 0.0;
        for (int i = 0; i < 3; ++i) {
            most = std::max(most, -shares[i] / a_pixel_[i]);
        }
        return most;
    }

  private:
    Vector2d corner_;
    Vector2d to_second_;
    Vector2d to_third_;
    double determinant_;
    Vector3d a_pixel_; ///< change of each coordinate per texel
};

/// Calls visit(column, row, barycentric coordinates, distance to the face) for a face's texels.
template <typename Visit>
void visit_texels(const std::array<Vector2d, 3>& corners, const Visit& visit)
{
    const Shares shares(corners);
    const Vector2d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).array() - kBeyondPx;
    const Vector2d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).array() + kBeyondPx;
    for (int y = static_cast<int>(std::floor(low.y())); y + 0.5 <= high.y(); ++y) {
        for (int x = static_cast<int>(std::floor(low.x())); x + 0.5 <= high.x(); ++x) {
            const Vector3d at = shares.at({x + 0.5, y + 0.5});
            const double beyond = shares.beyond(at);
            if (beyond <= kBeyondPx) visit(x, y, at, beyond);
        }
    }
}

/// A page, and the face that owns each texel.
struct Canvas {
    Photograph page;
    std::vector<std::uint32_t> owners;

    std::size_t texel(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width_px) +
               static_cast<std::size_t>(x);
    }
    static std::ptrdiff_t offset(std::size_t texel)
    {
        return static_cast<std::ptrdiff_t>(3 * texel);
    }
    void set(std::size_t texel, const Array3f& color)
    {
        std::ranges::copy(rounded_color(color), page.rgb.begin() + offset(texel));
    }
    Array3f get(std::size_t texel) const
    {
        return {static_cast<float>(page.rgb[3 * texel]),
                static_cast<float>(page.rgb[3 * texel + 1]),
                static_cast<float>(page.rgb[3 * texel + 2])};
    }
};

/// The color of a photograph from beyond a seam at a texel.
struct Stroke {
    std::uint64_t texel;
    std::uint32_t page;
    float weight;
    Array3f color;
};

Array3f mixed(const std::array<Array3f, 3>& corners, const Vector3d& shares)
{
    const Eigen::Vector3f s = shares.cast<float>();
    return s[0] * corners[0] + s[1] * corners[1] + s[2] * corners[2];
}

class Painter {
  public:
    explicit Painter(const PaintPlan& plan) : plan_(plan)
    {
        for (const Eigen::Array2i& size : plan.atlas.page_sizes) {
            Canvas& canvas = canvases_.emplace_back();
            canvas.page = {size.x(), size.y(), {}};
            const auto texels =
                static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y());
            canvas.page.rgb.resize(3 * texels);
            canvas.owners.assign(texels, kNoFace);
        }
        share_out();
    }

    /// Paints the faces of a photograph. Faces share no texels, so photographs may run in parallel.
    void paint(std::uint32_t photo, const std::vector<std::uint32_t>& faces,
               const PhotoPyramid& pyramid)
    {
        for (const std::uint32_t face : faces) {
            visit_own(face, [&](Canvas& canvas, std::size_t texel, const Vector3d& shares) {
                const auto color = seen(photo, face, shares, pyramid);
                canvas.set(texel, color ? *color + mixed(plan_.levels[face], shares)
                                        : vertex_color(face, shares));
            });
        }
    }

    std::vector<Stroke> strokes(std::uint32_t photo, const PhotoPyramid& pyramid)
    {
        std::vector<Stroke> strokes;
        for (const Blend& blend : plan_.blends[photo]) {
            const std::uint32_t page = plan_.atlas.page_of_face[blend.face];
            visit_own(blend.face, [&](Canvas&, std::size_t texel, const Vector3d& shares) {
                const auto far = static_cast<float>(shares[0]) * blend.far[0] +
                                 static_cast<float>(shares[1]) * blend.far[1] +
                                 static_cast<float>(shares[2]) * blend.far[2];
                if (far >= 1.0F) return;
                const auto color = seen(photo, blend.face, shares, pyramid);
                if (!color) return;
                strokes.push_back({texel, page, std::min(1.0F, 1.0F - far),
                                   *color + mixed(blend.levels, shares)});
            });
        }
        return strokes;
    }

    /// Blends all strokes of a texel at once, by their weights; the painted color has the weight 1.
    void blend(std::vector<Stroke> strokes)
    {
        std::ranges::stable_sort(strokes, [](const Stroke& a, const Stroke& b) {
            return std::tie(a.page, a.texel) < std::tie(b.page, b.texel);
        });
        for (std::size_t i = 0; i < strokes.size();) {
            Canvas& canvas = canvases_[strokes[i].page];
            const std::uint64_t texel = strokes[i].texel;
            const std::uint32_t page = strokes[i].page;
            Array3f sum = canvas.get(texel);
            float weights = 1.0F;
            for (; i < strokes.size() && strokes[i].texel == texel && strokes[i].page == page;
                 ++i) {
                sum += strokes[i].weight * strokes[i].color;
                weights += strokes[i].weight;
            }
            canvas.set(texel, sum / weights);
        }
    }

    /// Paints the faces that no photograph shows.
    void paint_unseen()
    {
        parallel_for(plan_.mesh.faces.size(), [&](std::size_t face) {
            if (plan_.photo_of_face[face] != kNoPhoto) return;
            const auto number = static_cast<std::uint32_t>(face);
            visit_own(number, [&](Canvas& canvas, std::size_t texel, const Vector3d& shares) {
                canvas.set(texel, vertex_color(number, shares));
            });
        });
    }

    std::vector<Photograph> take()
    {
        parallel_for(
            canvases_.size(), [&](std::size_t i) { surround(canvases_[i]); }, 1);
        std::vector<Photograph> pages;
        for (Canvas& canvas : canvases_) {
            pages.push_back(std::move(canvas.page));
        }
        return pages;
    }

  private:
    /// Assigns texels to faces: first the texels within a face, then the texels beside it.
    void share_out()
    {
        const Atlas& atlas = plan_.atlas;
        for (const bool within : {true, false}) {
            for (std::uint32_t face = 0; face < atlas.corners.size(); ++face) {
                Canvas& canvas = canvases_[atlas.page_of_face[face]];
                visit_texels(atlas.corners[face],
                             [&](int x, int y, const Vector3d&, double beyond) {
                                 std::uint32_t& owner = canvas.owners[canvas.texel(x, y)];
                                 if (owner == kNoFace && (!within || beyond == 0.0)) owner = face;
                             });
            }
        }
    }

    template <typename Visit>
    void visit_own(std::uint32_t face, const Visit& visit)
    {
        Canvas& canvas = canvases_[plan_.atlas.page_of_face[face]];
        visit_texels(plan_.atlas.corners[face],
                     [&](int x, int y, const Vector3d& shares, double /*beyond*/) {
                         const std::size_t texel = canvas.texel(x, y);
                         if (canvas.owners[texel] == face) visit(canvas, texel, shares);
                     });
    }

    /// Interpolates the colors of a face's vertices.
    Array3f vertex_color(std::uint32_t face, const Vector3d& shares) const
    {
        std::array<Array3f, 3> colors;
        for (int i = 0; i < 3; ++i) {
            colors[i] = channels_of(plan_.mesh.colors[plan_.mesh.faces[face][i]]);
        }
        return mixed(colors, shares);
    }

    /// The color in a photograph; nothing if it is transparent there.
    std::optional<Array3f> seen(std::uint32_t photo, std::uint32_t face, const Vector3d& shares,
                                const PhotoPyramid& pyramid) const
    {
        const auto [a, b, c] = corners_of(plan_.mesh.positions, plan_.mesh.faces[face]);
        const Vector3d place = shares[0] * a + shares[1] * b + shares[2] * c;
        const auto pixel = pixel_beyond(plan_.photos[photo], place);
        if (!pixel) return Array3f::Zero();
        if (!pyramid.shows(*pixel)) return std::nullopt;
        return pyramid.at(*pixel) * plan_.gains[photo];
    }

    /// The texel at an offset to the right and below; nothing beyond the page.
    static std::optional<std::size_t> beside_texel(const Canvas& canvas, std::size_t texel,
                                                   const std::array<int, 2>& side)
    {
        const auto width = static_cast<std::size_t>(canvas.page.width_px);
        const int x = static_cast<int>(texel % width) + side[0];
        const int y = static_cast<int>(texel / width) + side[1];
        if (x < 0 || x >= canvas.page.width_px || y < 0 || y >= canvas.page.height_px) {
            return std::nullopt;
        }
        return canvas.texel(x, y);
    }

    /// Extends the colors of charts by kPadding texels, and fills the rest with the mean color.
    static void surround(Canvas& canvas)
    {
        constexpr std::array<std::array<int, 2>, 4> kSides = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
        const auto is_bare = [&](std::optional<std::size_t> texel) {
            return texel && canvas.owners[*texel] == kNoFace;
        };
        std::vector<std::size_t> edge; // texels of the last round
        Eigen::Array3d sum = Eigen::Array3d::Zero();
        double count = 0.0;
        for (std::size_t texel = 0; texel < canvas.owners.size(); ++texel) {
            if (canvas.owners[texel] == kNoFace) continue;
            if (std::ranges::any_of(kSides, [&](const auto& side) {
                    return is_bare(beside_texel(canvas, texel, side));
                })) {
                edge.push_back(texel);
            }
            sum += canvas.get(texel).cast<double>();
            count += 1.0;
        }
        const Array3f mean = (sum / std::max(count, 1.0)).cast<float>();
        for (int round = 0; round < Atlas::kPadding; ++round) {
            std::vector<std::size_t> next;
            for (const std::size_t texel : edge) {
                for (const auto& side : kSides) {
                    const std::optional<std::size_t> beside = beside_texel(canvas, texel, side);
                    if (!is_bare(beside)) continue;
                    canvas.owners[*beside] = canvas.owners[texel];
                    canvas.set(*beside, canvas.get(texel));
                    next.push_back(*beside);
                }
            }
            edge = std::move(next);
        }
        for (std::size_t texel = 0; texel < canvas.owners.size(); ++texel) {
            if (canvas.owners[texel] == kNoFace) canvas.set(texel, mean);
        }
    }

    const PaintPlan& plan_;
    std::vector<Canvas> canvases_;
};

} // namespace

std::vector<Photograph> paint_pages(const PaintPlan& plan, const Progress& progress)
{
    Painter painter(plan);
    std::vector<std::vector<std::uint32_t>> faces_of_photo(plan.photos.size());
    for (std::uint32_t face = 0; face < plan.photo_of_face.size(); ++face) {
        if (plan.photo_of_face[face] != kNoPhoto) {
            faces_of_photo[plan.photo_of_face[face]].push_back(face);
        }
    }
    std::vector<std::vector<Stroke>> strokes(plan.photos.size());
    for_each_photograph(plan.photos, plan.photos_at_a_time, progress.part(0.0, 0.9),
                        [&](std::uint32_t photo, const PhotoPyramid& pyramid) {
                            painter.paint(photo, faces_of_photo[photo], pyramid);
                            strokes[photo] = painter.strokes(photo, pyramid);
                        });
    std::vector<Stroke> all;
    for (std::vector<Stroke>& of_photo : strokes) {
        all.insert(all.end(), of_photo.begin(), of_photo.end());
        of_photo = {};
    }
    painter.blend(std::move(all));
    painter.paint_unseen();
    return painter.take();
}

} // namespace vcarve
