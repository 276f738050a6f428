#include "figures/paper_case.h"

#include "base/progress.h"
#include "geometry/triangle.h"
#include "model/scene_points.h"
#include "model/visibility_energy.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/5_labels/label_cells.h"
#include "vcarve/io.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace vcarve::paper {

namespace {

double volume_of(const TetMesh& cells, Index cell)
{
    const auto& v = cells.cells[cell].vertices;
    const Eigen::Vector3d& a = cells.positions[v[0]];
    return scaled_normal(a, cells.positions[v[1]], cells.positions[v[2]])
               .dot(cells.positions[v[3]] - a) /
           6.0;
}

} // namespace

Crossings crossings_of(const TetMesh& cells, const Scene& scene)
{
    Crossings crossings;
    CrossingCounter(cells).cast(photographs(scene), crossings, {});
    return crossings;
}

PaperCase read_case(const std::filesystem::path& fixtures, const std::string& name)
{
    Log silent;
    PaperCase made;
    made.name = name;
    made.scene = read_model(fixtures / name, silent);
    made.solid = read_ply(fixtures / name / "solid.ply");
    made.cells = triangulate(made.scene);
    made.crossings = crossings_of(made.cells, made.scene);
    made.truth = carve(made.cells, made.crossings, 1);
    return made;
}

Scene seen_by(const Scene& scene, const std::vector<std::uint32_t>& views)
{
    Scene result = scene;
    result.tracks = {};
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        std::vector<std::uint32_t> row;
        std::ranges::copy_if(scene.tracks[point], std::back_inserter(row),
                             [&](std::uint32_t view) { return std::ranges::count(views, view); });
        result.tracks.push_back(row);
    }
    return result;
}

std::vector<std::array<std::array<double, 3>, 3>> sorted_places(const TriMesh& mesh)
{
    std::vector<std::array<std::array<double, 3>, 3>> result;
    for (const Face& face : mesh.faces) {
        std::array<std::array<double, 3>, 3> corners{};
        std::ranges::transform(face, corners.begin(), [&](std::uint32_t vertex) {
            const Eigen::Vector3d place = mesh.positions[vertex] + mesh.offset;
            return std::array<double, 3>{place.x(), place.y(), place.z()};
        });
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        result.push_back(corners);
    }
    std::ranges::sort(result);
    return result;
}

bool is_exact(const TriMesh& surface, const TriMesh& solid)
{
    return sorted_places(surface) == sorted_places(solid);
}

double volume_of(const TriMesh& surface)
{
    double sum = 0.0;
    for (const Face& face : surface.faces) {
        const auto [a, b, c] = corners_of(surface.positions, face);
        sum += a.dot(b.cross(c)) / 6.0;
    }
    return sum;
}

double area_of(const TriMesh& surface)
{
    double sum = 0.0;
    for (const Face& face : surface.faces) {
        sum += face_area(surface.positions, face);
    }
    return sum;
}

Mistakes mistakes_of(const PaperCase& paper_case, const Labels& labels)
{
    Mistakes found;
    for (Index cell = 0; cell < labels.size(); ++cell) {
        const bool is_right = labels[cell] == paper_case.truth[cell];
        if (is_right || paper_case.cells.cells[cell].is_infinite()) continue;
        if (labels[cell] == Label::outside) {
            ++found.lost;
        } else {
            ++found.kept;
            found.kept_volume += volume_of(paper_case.cells, cell);
        }
    }
    return found;
}

std::vector<std::uint32_t> views_that_open_most(const PaperCase& paper_case, std::size_t count)
{
    std::vector<std::uint32_t> chosen;
    while (chosen.size() < count) {
        std::pair<std::size_t, std::uint32_t> best{paper_case.cells.cells.size(), 0};
        for (std::uint32_t view = 0; view < paper_case.scene.views.size(); ++view) {
            std::vector<std::uint32_t> tried = chosen;
            tried.push_back(view);
            const Scene scene = seen_by(paper_case.scene, tried);
            const Labels labels = carve(paper_case.cells, crossings_of(paper_case.cells, scene), 1);
            best = std::min(best, {mistakes_of(paper_case, labels).kept, view});
        }
        chosen.push_back(best.second);
    }
    return chosen;
}

} // namespace vcarve::paper
