#include "sample_scene.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <exception>
#include <string_view>

namespace {

std::size_t count_in(std::string_view text)
{
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count == 0) {
        throw vcarve::UsageError(fmt::format("expected a number of points, not \"{}\"", text));
    }
    return count;
}

} // namespace

int main(int count, char** words)
{
    try {
        if (count != 4)
            throw vcarve::UsageError("make_sample_model surface|terrain|hall|wide POINTS FOLDER");
        const std::size_t points = count_in(words[2]);
        vcarve::bench::SampleKind kind;
        kind.shape = vcarve::bench::shape_named(words[1]);
        vcarve::bench::write_colmap_model(words[3], *vcarve::bench::sample_parts(kind, points));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_sample_model: %s\n", error.what());
        return 2;
    }
}
