#include "quadrel/film/film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/resolve.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Hash = std::function<std::string(const Film&)>;
using Resolve = std::function<ColorSample(std::span<const ColorSample>)>;

TEST(Sha256, MatchesTheStandardsVectors) {
    EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_hex("abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    Sha256 parts;
    parts.update("a");
    parts.update("bc");
    EXPECT_EQ(parts.hex(), sha256_hex("abc"));
}

AssertionResult tells_films_apart(const Hash& hash) {
    const Film film = testing_films::random_film(1);
    const std::function<void(Film&)> changes[] = {
        [](Film& f) { f.planes[2].name = "other"; },
        [](Film& f) { f.planes[7].type = ChannelType::float32; },
        [](Film& f) { f.planes[3].bits[40] ^= 1; },
        [](Film& f) { f.planes[3].bits[6] = 0; },  // -0 to +0
        [](Film& f) { f.frame.x1 += 1; },
        [](Film& f) {
            f.window = {4, 2, 13, 11};
        },
        [](Film& f) { f.planes.pop_back(); },
        [](Film& f) { std::swap(f.planes[0].bits, f.planes[1].bits); },
    };
    int number = 0;
    for (const auto& change : changes) {
        Film other = film;
        change(other);
        if (hash(other) == hash(film)) return AssertionFailure() << "change " << number;
        ++number;
    }
    return AssertionSuccess();
}

AssertionResult ignores_order_and_payload(const Hash& hash) {
    const Film film = testing_films::random_film(2);
    Film canonical = testing_films::sorted_by_name(film);
    canonicalize(canonical);
    if (hash(canonical) != hash(film)) return AssertionFailure() << "equal films, other hash";
    return AssertionSuccess();
}

std::string hash_with(FilmError error, Film film) {
    if (error == FilmError::hash_ignores_window) film.window = {0, 0, 9, 9};
    if (error == FilmError::hash_ignores_names)
        for (std::size_t i = 0; i < film.planes.size(); ++i)
            film.planes[i].name = std::to_string(i);
    if (error != FilmError::hash_keeps_nan_payload) return film_hash(film);
    for (Plane& plane : film.planes) plane.type = ChannelType::uint32;
    return film_hash(film);
}

TEST(FilmHash, TellsFilmsApartAndNothingElse) {
    EXPECT_TRUE(tells_films_apart(film_hash));
    EXPECT_TRUE(ignores_order_and_payload(film_hash));
    const auto with = [](FilmError error) {
        return [error](const Film& film) { return hash_with(error, film); };
    };
    EXPECT_FALSE(tells_films_apart(with(FilmError::hash_ignores_names)));
    EXPECT_FALSE(tells_films_apart(with(FilmError::hash_ignores_window)));
    EXPECT_FALSE(ignores_order_and_payload(with(FilmError::hash_keeps_nan_payload)));
}

Film cut(const Film& film, const Window& window) {
    Film part{film.frame, window, {}};
    for (const Plane& plane : film.planes) {
        Plane& copy = part.add(plane.name, plane.type);
        for (int y = window.y0; y < window.y1; ++y)
            for (int x = window.x0; x < window.x1; ++x)
                copy.bits[part.index(x, y)] = plane.bits[film.index(x, y)];
    }
    return part;
}

TEST(Join, FourWindowsGiveTheWhole) {
    const Film film = testing_films::random_film(3);
    const std::vector<Film> parts = {cut(film, {7, 5, 12, 11}), cut(film, {3, 2, 7, 5}),
                                     cut(film, {7, 2, 12, 5}), cut(film, {3, 5, 7, 11})};
    EXPECT_EQ(join(parts), film);
}

TEST(Join, RefusesGapsOverlapsAndOtherChannels) {
    const Film film = testing_films::random_film(3);
    const Film left = cut(film, {3, 2, 7, 11}), right = cut(film, {7, 2, 12, 11});
    EXPECT_THROW(join(std::vector<Film>{left, cut(film, {8, 2, 12, 11})}), UsageError);
    EXPECT_THROW(join(std::vector<Film>{left, cut(film, {6, 2, 12, 11})}), UsageError);
    EXPECT_THROW(join(std::vector<Film>{}), UsageError);
    Film renamed = right;
    renamed.planes[0].name = "other";
    EXPECT_THROW(join(std::vector<Film>{left, renamed}), UsageError);
    Film fewer = right;
    fewer.planes.pop_back();
    EXPECT_THROW(join(std::vector<Film>{left, fewer}), UsageError);
}

ColorSample resolve_with(FilmError error, std::span<const ColorSample> samples) {
    if (error == FilmError::resolve_reversed) {
        const std::vector<ColorSample> reversed(samples.rbegin(), samples.rend());
        return resolve(reversed);
    }
    ColorSample result = resolve(samples);
    if (error == FilmError::resolve_farthest)
        for (const ColorSample& sample : samples) result.z = std::max(result.z, sample.z);
    if (error == FilmError::resolve_first_nan && std::isnan(samples[0].z)) result.z = samples[0].z;
    return result;
}

/// Sums in the written order: (big + 1) - big differs from big - big + 1.
AssertionResult resolves_in_order(const Resolve& resolve_) {
    const float big = 16777216.0f;
    const ColorSample samples[4] = {
        {big, 0, 0, 1, 5}, {1, 0, 0, 1, 3}, {-big, 4, 0, 0, 4}, {0.5f, 0, 0, 1, HUGE_VALF}};
    const ColorSample result = resolve_(samples);
    const float expected = (((big + 1.0f) + -big) + 0.5f) * 0.25f;
    if (result.r != expected) return AssertionFailure() << result.r << " for " << expected;
    if (result.g != 1 || result.a != 0.75f) return AssertionFailure() << "mean of g or a";
    return AssertionSuccess();
}

AssertionResult keeps_nearest(const Resolve& resolve_) {
    const ColorSample samples[2] = {{0, 0, 0, 0, NAN}, {0, 0, 0, 0, 7}};
    const ColorSample swapped[2] = {samples[1], samples[0]};
    const ColorSample finite[2] = {{0, 0, 0, 0, 3}, {0, 0, 0, 0, 7}};
    if (resolve_(samples).z != 7 || resolve_(swapped).z != 7) return AssertionFailure() << "NaN";
    if (resolve_(finite).z != 3) return AssertionFailure() << "not the nearest";
    return AssertionSuccess();
}

TEST(Resolve, MeansInOrderAndNearestDistance) {
    const auto with = [](FilmError error) {
        return
            [error](std::span<const ColorSample> samples) { return resolve_with(error, samples); };
    };
    EXPECT_TRUE(resolves_in_order(resolve));
    EXPECT_TRUE(keeps_nearest(resolve));
    EXPECT_FALSE(resolves_in_order(with(FilmError::resolve_reversed)));
    EXPECT_FALSE(keeps_nearest(with(FilmError::resolve_farthest)));
    EXPECT_FALSE(keeps_nearest(with(FilmError::resolve_first_nan)));
}

TEST(Resolve, EqualSamplesKeepTheirValue) {
    const ColorSample sample{0.1f, 0.7f, 1e-30f, 1, 2};
    for (const std::size_t count : {1u, 2u, 4u, 8u, 16u}) {
        const std::vector<ColorSample> samples(count, sample);
        const ColorSample result = resolve(samples);
        EXPECT_NEAR(result.r, sample.r, 1e-7f) << count;
        EXPECT_EQ(result.a, 1) << count;
        EXPECT_EQ(result.z, 2) << count;
    }
}

}  // namespace
}  // namespace quadrel
