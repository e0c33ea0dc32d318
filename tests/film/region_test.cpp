// What compare does with crops, and with integers beside floats.
#include <gtest/gtest.h>

#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/compare.hpp"
#include "quadrel/film/comparable.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::bits;

using Crop = std::function<void(Film&, const Window&)>;

AssertionResult keeps_pixels_in_place(const Crop& crop_) {
    const Film whole = testing_films::random_film(5, {0, 0, 17, 13}, {3, 2, 12, 11});
    for (const Window window :
         {Window{3, 2, 12, 11}, Window{4, 3, 11, 9}, Window{11, 10, 12, 11}, Window{3, 2, 4, 11}}) {
        Film part = whole;
        crop_(part, window);
        if (part.window != window || part.frame != whole.frame)
            return AssertionFailure() << "the windows";
        for (std::size_t p = 0; p < whole.planes.size(); ++p) {
            if (part.planes[p].bits.size() != window.area())
                return AssertionFailure() << "another number of pixels";
            for (int y = window.y0; y < window.y1; ++y)
                for (int x = window.x0; x < window.x1; ++x)
                    if (part.planes[p].bits[part.index(x, y)] !=
                        whole.planes[p].bits[whole.index(x, y)])
                        return AssertionFailure() << x << "," << y;
        }
    }
    return AssertionSuccess();
}

TEST(Region, ACropKeepsPixelsInPlace) {
    EXPECT_TRUE(keeps_pixels_in_place(crop));
    EXPECT_FALSE(keeps_pixels_in_place([](Film& film, const Window& window) {  // crop_keeps_rows
        for (Plane& plane : film.planes) plane.bits.resize(window.area());
        film.window = window;
    }));
}

TEST(Region, IntersectionsMayBeEmpty) {
    const Window a{0, 0, 8, 8};
    EXPECT_EQ(intersection(a, {3, 2, 20, 5}), (Window{3, 2, 8, 5}));
    EXPECT_LT(intersection(a, {9, 2, 20, 5}).width(), 1);
}

Film with_steps(ChannelType type, const std::vector<std::uint32_t>& values) {
    Film film{{0, 0, 4, 1}, {0, 0, 4, 1}, {}};
    film.add("hit.steps", type).bits = values;
    return film;
}

using ByValue = std::function<std::vector<std::string>(Film&, Film&)>;

AssertionResult compares_values(const ByValue& by_value) {
    const Film integers = with_steps(ChannelType::uint32, {0, 7, 0xffffffffu, 1u << 24});
    const Film floats = with_steps(ChannelType::float32,
                                   {bits(-0.0f), bits(7), bits(4294967296.0f), bits(0x1p24f)});
    for (const bool turned : {false, true}) {
        Film a = turned ? floats : integers, b = turned ? integers : floats;
        if (by_value(a, b) != std::vector<std::string>{"hit.steps"})
            return AssertionFailure() << "the channel is not named";
        if (!compare(a, b).equal()) return AssertionFailure() << "equal values differ";
        Film c = turned ? floats : integers, d = turned ? integers : floats;
        (turned ? c : d).planes[0].bits[1] = bits(7.5f);
        by_value(c, d);
        if (compare(c, d).equal()) return AssertionFailure() << "7.5 for 7";
    }
    return AssertionSuccess();
}

TEST(Region, IntegersBesideFloatsAreComparedByValue) {
    EXPECT_TRUE(compares_values(compare_by_value));
    EXPECT_FALSE(compares_values([](Film& a, Film& b) {  // by_value_keeps_bits
        a.planes[0].type = b.planes[0].type = ChannelType::float32;
        return std::vector<std::string>{"hit.steps"};
    }));
    Film a = with_steps(ChannelType::uint32, {1, 2, 3, 4}), b = a;
    EXPECT_TRUE(compare_by_value(a, b).empty());
    EXPECT_EQ(a.planes[0].type, ChannelType::uint32);
}

}  // namespace
}  // namespace quadrel
