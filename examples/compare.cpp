// example_compare MODEL MESH.ply [TRUTH.ply]: compares a mesh with the views of a model, and with
// the true surface if it is known.
#include <vcarve/vcarve.h>

#include <iostream>
#include <optional>

int main(int count, char** words)
{
    if (count != 3 && count != 4) return 2;
    try {
        vcarve::Log silent;
        const vcarve::Scene model = vcarve::read_model(words[1], silent);
        const vcarve::NamedMesh mesh = {words[2], vcarve::read_ply(words[2])};
        std::optional<vcarve::NamedMesh> truth;
        if (count == 4) truth = {words[3], vcarve::read_ply(words[3])};

        const vcarve::ComparisonReport report = vcarve::compare(
            model, std::span(&mesh, 1), truth ? &*truth : nullptr, {.samples = 20000}, silent);
        std::cout << report.table;
        std::cerr << "hidden rays: " << report.figures[0].at("/views/hidden_rays") << '\n';
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
