#include "options/declared.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace vcarve::declared_test {
namespace {

/// Converts to the type of any field.
struct Anything {
    template <typename T>
    operator T() const; // NOLINT(google-explicit-constructor): converts implicitly
};

/// The number of fields of an aggregate.
template <typename T, typename... Fields>
constexpr std::size_t num_fields()
{
    if constexpr (requires { T{Fields()..., Anything()}; }) {
        return num_fields<T, Fields..., Anything>();
    } else {
        return sizeof...(Fields);
    }
}

TEST(DeclaredOptions, CoverAllFieldsOfOptions)
{
    constexpr std::size_t kParts = num_fields<FilterOptions>() + num_fields<AddedPointOptions>() +
                                   num_fields<ThinOptions>() + num_fields<CropOptions>() +
                                   num_fields<DenoiseOptions>();
    constexpr std::size_t kLabels = num_fields<LabelOptions>() - 4 + num_fields<TraceOptions>() +
                                    num_fields<CutOptions>() + num_fields<HullOptions>() +
                                    num_fields<VirtualViewOptions>();
    constexpr std::size_t kSurface = num_fields<SurfaceOptions>() - 2 + num_fields<FaceRules>() +
                                     num_fields<CleanupOptions>() + num_fields<SmoothOptions>() +
                                     num_fields<SimplifyOptions>();
    constexpr std::size_t kRun = num_fields<MemoryOptions>() + 1; // and threads
    // and the folders of photographs and masks
    constexpr std::size_t kPhotos = num_fields<DenseOptions>() + num_fields<TextureOptions>() + 2;
    static_assert(num_fields<Options>() == 14 && num_fields<RefineOptions>() == 2);
    Options options;
    EXPECT_EQ(options_of(options).size(), kPhotos + kParts + kLabels + kSurface + kRun);
}

TEST(DeclaredOptions, HaveUniqueNamesAndHelp)
{
    Options options;
    std::set<std::string> names;
    for (const Option& option : options_of(options)) {
        EXPECT_TRUE(names.insert(option.info.name).second) << option.info.name;
        EXPECT_FALSE(option.info.help.empty()) << option.info.name;
    }
    EXPECT_NO_THROW(validate(options));
}

TEST(PointsArguments, DeclareEveryFieldOfPointsOptions)
{
    PointsArguments arguments;
    std::string names;
    for (const Option& option : options_of(arguments)) {
        names += option.info.name + " ";
    }
    EXPECT_EQ(names, "points visibility rays scanner ");
}

TEST(PointsArguments, SetAScannerOnlyIfAPositionIsTyped)
{
    PointsArguments arguments;
    const Option scanner = options_of(arguments).back();
    set_value(scanner, "1,2,3");
    EXPECT_EQ(arguments.all_points().scanner, Eigen::Vector3d(1.0, 2.0, 3.0));
    set_value(scanner, "file");
    EXPECT_FALSE(arguments.all_points().scanner.has_value());
}

} // namespace
} // namespace vcarve::declared_test
