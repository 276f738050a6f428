#include "cli/option_table.h"
#include "support/sample_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::cli {
namespace {

using testing::ElementsAre;

std::vector<OptionRow> sample_rows()
{
    SampleOptions options;
    OptionTable table;
    options.visit(table);
    return table.rows();
}

TEST(OptionTable, ListsEveryOptionInTheOrderOfItsDeclaration)
{
    std::vector<std::string> names;
    for (const OptionRow& row : sample_rows()) {
        names.push_back(row.stage + "/" + row.name);
    }
    EXPECT_THAT(names, ElementsAre("First/angle", "First/spacing", "Second/min-views",
                                   "Second/closed", "Second/no-smooth", "Second/shape",
                                   "Second/memory", "Second/place", "Second/part"));
}

TEST(OptionTable, TakesThePresentValuesForDefaults)
{
    std::vector<std::string> defaults;
    for (const OptionRow& row : sample_rows()) {
        defaults.push_back(row.initial);
    }
    EXPECT_THAT(defaults, ElementsAre("10.5", "2", "3", "", "", "round", "3M", "here", "none"));
}

TEST(OptionTable, GivesARangeOnlyWhereMoreThanTheSignIsRestricted)
{
    std::vector<std::string> ranges;
    for (const OptionRow& row : sample_rows()) {
        ranges.push_back(row.range);
    }
    EXPECT_THAT(ranges, ElementsAre("0 to 180", "", "2 or more", "", "", "", "", "-10 to 10", ""));
}

TEST(Placeholder, ShowsTheUnitOrTheChoices)
{
    std::vector<std::string> placeholders;
    for (const OptionRow& row : sample_rows()) {
        placeholders.push_back(placeholder(row));
    }
    EXPECT_THAT(placeholders, ElementsAre("<deg>", "<number>", "<views>", "", "", "round|flat",
                                          "<size>", "here|there|x,y,z", "none|auto|box|<file>"));
}

} // namespace
} // namespace vcarve::cli
