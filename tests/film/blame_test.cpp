// Blame: a planted error spreads downstream, and its source is named.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/compare.hpp"
#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::bits;
using FindBlame = std::function<std::optional<Blame>(const Film&, const Film&, const CompareRules&,
                                                     const CompareReport&)>;

/// Channels of every stage, in the order in which a file holds them: by name.
Film staged_film() {
    Film film{{0, 0, 8, 8}, {2, 2, 8, 8}, {}};
    for (const char* name :
         {"B", "B.X", "G", "J.U.X", "K.U", "N.X", "P.X", "R", "Z", "dUVdx.U", "hit.U", "hit.s",
          "light.diffuse.R", "lod.lambda", "shadow.visibility", "uv.U"})
        film.add(name, ChannelType::float32, bits(1.0f));
    return film;
}

const std::vector<std::string> in_order = {"P.X",
                                           "uv.U",
                                           "dUVdx.U",
                                           "B.X",
                                           "J.U.X",
                                           "K.U",
                                           "lod.lambda",
                                           "hit.U",
                                           "hit.s",
                                           "Z",
                                           "N.X",
                                           "shadow.visibility",
                                           "light.diffuse.R",
                                           "R",
                                           "G",
                                           "B"};

/// Every channel from `source` on is wrong at pixel 5,4, worst in the colour; the channels before
/// it are wrong at another pixel, by less.
AssertionResult names_every_source(const FindBlame& find) {
    for (std::size_t source = 0; source < in_order.size(); ++source) {
        const Film reference = staged_film();
        Film test = reference;
        for (Plane& plane : test.planes) {
            const auto place = std::find(in_order.begin(), in_order.end(), plane.name);
            const bool wrong = place - in_order.begin() >= static_cast<std::ptrdiff_t>(source);
            plane.bits[test.index(3, 3)] = bits(1.25f);
            if (wrong) plane.bits[test.index(5, 4)] = bits(2.0f);
        }
        const CompareRules rules;
        const auto blame = find(reference, test, rules, compare(reference, test, rules));
        if (!blame) return AssertionFailure() << "nothing blamed";
        if (blame->x != 5 || blame->y != 4 || blame->symptom != "B")
            return AssertionFailure() << blame->symptom << " " << blame->x << "," << blame->y;
        if (blame->first != in_order[source])
            return AssertionFailure() << blame->first << " instead of " << in_order[source];
        if (blame->upstream.size() != source || blame->test != bits(2.0f))
            return AssertionFailure() << "upstream of " << blame->first;
    }
    return AssertionSuccess();
}

TEST(Blame, NamesTheFirstWrongChannelOfTheWorstPixel) {
    EXPECT_TRUE(names_every_source(find_blame));
    EXPECT_FALSE(names_every_source([](const Film& a, const Film& b, const CompareRules& rules,
                                       const CompareReport& report) {  // blame_last
        auto blame = find_blame(a, b, rules, report);
        blame->first = blame->symptom;
        return blame;
    }));
    EXPECT_FALSE(names_every_source([](const Film& a, const Film& b, const CompareRules& rules,
                                       const CompareReport& report) {  // blame_other_pixel
        auto blame = find_blame(a, b, rules, report);
        blame->first = "P.X";  // wrong too, elsewhere
        return blame;
    }));
}

TEST(Blame, KeepsToTolerances) {
    const Film reference = staged_film();
    Film test = reference;
    for (Plane& plane : test.planes) plane.bits[0] = bits(1.5f);
    CompareRules rules;
    rules.channels["P.X"].abs = rules.channels["uv.U"].abs = 0.5;
    const auto blame = find_blame(reference, test, rules, compare(reference, test, rules));
    ASSERT_TRUE(blame.has_value());
    EXPECT_EQ(blame->first, "dUVdx.U");
    rules.all.abs = 0.5;
    EXPECT_FALSE(find_blame(reference, test, rules, compare(reference, test, rules)).has_value());
}

TEST(Blame, EveryChannelHasAPlaceInTheDataFlow) {
    const std::size_t unknown = data_flow_rank("no.such");
    for (const ChannelInfo& channel : channel_table())
        EXPECT_LT(data_flow_rank(channel.name), unknown) << channel.name;
    EXPECT_LT(data_flow_rank("B.X"), data_flow_rank("B"));
    EXPECT_EQ(data_flow_rank("shadow.2.visibility"), data_flow_rank("shadow.visibility"));
}

}  // namespace
}  // namespace quadrel
