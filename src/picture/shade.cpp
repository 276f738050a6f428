#include "picture/shade.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/first_faces.h"
#include "model/colors.h"
#include "model/photograph.h"
#include "picture/eye.h"

#include <array>
#include <optional>

namespace vcarve {

namespace {

using Eigen::Array3f;
using Eigen::Vector3d;

constexpr int kSamplesASide = 2;
constexpr int kSamples = kSamplesASide * kSamplesASide;
/// The brightness of a face seen edge-on. It is high because colors include the scene's lighting.
constexpr double kLeastLight = 0.55;
/// The color strength of normals. It is less than 1, so that no normal has the color kBack.
constexpr float kNormalStrength = 0.75F;

/// The colors of one ray in both pictures.
struct Sample {
    Array3f shaded;
    Array3f normal;
};

Sample even_sample(const Array3f& color)
{
    return {color, color};
}

std::array<float, 3> shares_of(const FirstFace& hit)
{
    return {1.0F - hit.second - hit.third, hit.second, hit.third};
}

Array3f texture_color(const Texture& texture, const FirstFace& hit)
{
    const Photograph& page = texture.pages[texture.page_of_face[hit.face]];
    const std::array<float, 3> shares = shares_of(hit);
    Eigen::Vector2f place = Eigen::Vector2f::Zero();
    for (int i = 0; i < 3; ++i) {
        place += shares[i] * texture.places[hit.face][i];
    }
    const Eigen::Vector2d size(page.width_px, page.height_px);
    return between_pixels(page, place.cast<double>().cwiseProduct(size));
}

Array3f own_color(const TriMesh& mesh, const FirstFace& hit)
{
    if (mesh.colors.empty()) return kUncolored;
    const Face& face = mesh.faces[hit.face];
    const std::array<float, 3> shares = shares_of(hit);
    Array3f sum = Array3f::Zero();
    for (int i = 0; i < 3; ++i) {
        sum += shares[i] * channels_of(mesh.colors[face[i]]);
    }
    return sum;
}

/// Computes the colors of single rays.
class Looker {
  public:
    Looker(const TriMesh& mesh, const Texture& texture, const Eye& eye)
        : mesh_(mesh),
          texture_(texture),
          eye_(eye),
          faces_(mesh, eye.center - mesh.offset),
          world_from_cam_(eye.cam_from_world.toRotationMatrix().transpose())
    {
    }

    /// `in_camera` is the unit direction in the camera's frame, or empty if the lens has none.
    Sample along(const std::optional<Vector3d>& in_camera) const
    {
        if (!in_camera) return even_sample(kNoRay);
        const Vector3d towards = world_from_cam_ * *in_camera;
        const FirstFace hit = first_face(towards);
        if (hit.face == FirstFace::kNone) return even_sample(kNothing);
        const Vector3d normal = face_normal(mesh_.positions, mesh_.faces[hit.face]);
        const double facing = -normal.dot(towards);
        if (!(facing > 0.0)) return even_sample(kBack);
        const auto light = static_cast<float>(kLeastLight + (1.0 - kLeastLight) * facing);
        // The camera's y points down and its z forward.
        const Vector3d turned = world_from_cam_.transpose() * normal;
        const Array3f shown = Vector3d(turned.x(), -turned.y(), -turned.z()).cast<float>().array();
        const Array3f color = texture_.is_empty() ? Array3f(light * own_color(mesh_, hit))
                                                  : texture_color(texture_, hit);
        return {color, 127.5F * (1.0F + kNormalStrength * shown)};
    }

  private:
    FirstFace first_face(const Vector3d& towards) const
    {
        if (eye_.through_backs) {
            const FirstFace front = faces_.front_along(towards);
            if (front.face != FirstFace::kNone) return front;
        }
        return faces_.along(towards);
    }

    const TriMesh& mesh_;
    const Texture& texture_;
    const Eye& eye_;
    FirstFaces faces_;
    Eigen::Matrix3d world_from_cam_;
};

} // namespace

Looks look_at(const TriMesh& mesh, const Texture& texture, const Eye& eye, double most_pixels)
{
    const Eigen::Array2i size = picture_size(eye.camera, most_pixels);
    const int width_px = size.x();
    Looks looks{even_picture(width_px, size.y(), Array3f::Zero()),
                even_picture(width_px, size.y(), Array3f::Zero())};
    const LensRays rays(eye.camera, size);
    const Looker looker(mesh, texture, eye);
    const auto fill = [&](std::size_t pixel) {
        const auto x = static_cast<int>(pixel % width_px);
        const auto y = static_cast<int>(pixel / width_px);
        for (int i = 0; i < kSamples; ++i) {
            const Eigen::Array2i column_and_row(i % kSamplesASide, i / kSamplesASide);
            const Eigen::Array2d within = (column_and_row.cast<double>() + 0.5) / kSamplesASide;
            const Sample sample = looker.along(rays.at(x, y, within));
            looks.shaded.pixels[pixel] += sample.shaded / kSamples;
            looks.normals.pixels[pixel] += sample.normal / kSamples;
        }
    };
    parallel_for(looks.shaded.pixels.size(), fill, 2048);
    return looks;
}

} // namespace vcarve
