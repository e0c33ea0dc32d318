// What a filtered look-up may give, as a linear form in the errors that its coordinates share with
// those of other look-ups: heights beside a hit move together when the hit moves.
//
// By the mean value theorem h(c + e) = h(c) + g e for some gradient g that the filter has between c
// and c + e. The middle of all such gradients goes with the named errors of the coordinates, the
// rest is the look-up's own.
#pragma once

#include "quadrel/texture/range/footprint.hpp"

namespace quadrel::range_detail {

/// at + sum part e + up to +-rest, of each channel.
struct LinearForm {
    double at[4], part[3][4], rest[4];
};

/// What gradients a patch has over weights in x and y, in units a texel: one axis' ends.
struct PatchGradients {
    RealInterval x[4], y[4];
};
template <class Texels>
bool include_gradients(PatchGradients& all, const Texels& level, double i, double j,
                       const RealInterval& x, const RealInterval& y) {
    const TexelValue taps[4] = {level.at(i, j), level.at(i + 1, j), level.at(i, j + 1),
                                level.at(i + 1, j + 1)};
    const auto include = [](RealInterval& range, double first, double second,
                            const RealInterval& weight) {
        for (const double t : {weight.lo, weight.hi})
            range = hull(range, RealInterval(first + t * (second - first)));
    };
    for (int c = 0; c < 4; ++c) {
        const double a = taps[0].channel[c], b = taps[1].channel[c], d = taps[2].channel[c],
                     e = taps[3].channel[c];
        if (!(std::fabs(a) + std::fabs(b) + std::fabs(d) + std::fabs(e) < 0x1p100)) return false;
        include(all.x[c], b - a, e - d, y);
        include(all.y[c], d - a, e - b, x);
    }
    return true;
}

/// All gradients that patches have over ranges of texel coordinates; false where more than `most`
/// patches are met, or one of what is no number.
template <class Texels>
bool gradients_over(PatchGradients& all, const Texels& level, const RealInterval& x,
                    const RealInterval& y, double most) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const RealInterval centred_x(x.lo - 0.5, x.hi - 0.5), centred_y(y.lo - 0.5, y.hi - 0.5);
    const RealInterval column(std::floor(centred_x.lo), std::floor(centred_x.hi));
    const RealInterval row(std::floor(centred_y.lo), std::floor(centred_y.hi));
    if (!((column.width() + 1) * (row.width() + 1) <= most)) return false;
    for (int c = 0; c < 4; ++c) all.x[c] = all.y[c] = {infinity, -infinity};
    for (double j = row.lo; j <= row.hi; ++j)
        for (double i = column.lo; i <= column.hi; ++i)
            if (!include_gradients(all, level, i, j, weights_in(centred_x, i),
                                   weights_in(centred_y, j)))
                return false;
    return true;
}

/// One coordinate: its middle, what it has of named errors, and how far it may be beside that.
struct SharedCoordinate {
    double middle, part[3], own;

    SharedCoordinate(const Ranged& u, const RealInterval& x, double size) {
        double named = 0;
        for (int k = 0; k < 3; ++k) {
            part[k] = u.part[k] * size;
            named += std::fabs(part[k]);
        }
        middle = x.middle();
        own = std::max(0.0, next_up(std::max(x.hi - middle, middle - x.lo)) - named) +
              named * 0x1p-40;
    }
};

/// The form of a level's linear filter; false where coordinates share nothing, or too many texels
/// are met.
template <class Texels>
bool linear_form(LinearForm& form, const Texels& level, const Ranged& u, const Ranged& v) {
    constexpr double most = 9;
    if (u.named == 0 || u.named != v.named || !u.is_bounded() || !v.is_bounded()) return false;
    const RealInterval x = texel_coordinates(u.range(), level.width(), level.sampler());
    const RealInterval y = texel_coordinates(v.range(), level.height(), level.sampler());
    if (std::max(x.magnitude(), y.magnitude()) > 0x1p24) return false;
    PatchGradients gradients;
    if (!gradients_over(gradients, level, x, y, most)) return false;
    const SharedCoordinate of_x(u, x, level.width()), of_y(v, y, level.height());
    TexelRange middle = TexelRange::nothing();
    if (!include_linear(middle, level, of_x.middle, of_y.middle)) return false;
    for (int c = 0; c < 4; ++c) {
        const RealInterval gx = gradients.x[c], gy = gradients.y[c];
        form.at[c] = middle.channel[c].middle();
        double rest =
            middle.channel[c].width() + of_x.own * gx.magnitude() + of_y.own * gy.magnitude();
        double size = gx.magnitude() + gy.magnitude() + std::fabs(form.at[c]);
        for (int k = 0; k < 3; ++k) {
            form.part[k][c] = gx.middle() * of_x.part[k] + gy.middle() * of_y.part[k];
            rest +=
                gx.width() / 2 * std::fabs(of_x.part[k]) + gy.width() / 2 * std::fabs(of_y.part[k]);
        }
        form.rest[c] = rest * (1 + 0x1p-40) + size * 0x1p-40;
    }
    return true;
}

/// f + w (c - f) for a weight w; `free_error`: the named error that w moves with, or none (-1).
inline LinearForm blended(const LinearForm& fine, const LinearForm& coarse, const RealInterval& w,
                          int free_error) {
    LinearForm form;
    const double middle = w.middle(), radius = next_up(std::max(w.hi - middle, middle - w.lo));
    for (int c = 0; c < 4; ++c) {
        const double step = coarse.at[c] - fine.at[c];
        double spread = fine.rest[c] + coarse.rest[c], size = std::fabs(step);
        form.at[c] = fine.at[c] + middle * step;
        for (int k = 0; k < 3; ++k) {
            const double change = coarse.part[k][c] - fine.part[k][c];
            form.part[k][c] = fine.part[k][c] + middle * change;
            spread += std::fabs(change);
            size += std::fabs(fine.part[k][c]) + std::fabs(coarse.part[k][c]);
        }
        double rest = (1 - middle) * fine.rest[c] + middle * coarse.rest[c] + radius * spread;
        if (free_error >= 0)
            form.part[free_error][c] += radius * step;
        else
            rest += radius * std::fabs(step);
        form.rest[c] = rest * (1 + 0x1p-40) + (size + std::fabs(fine.at[c])) * 0x1p-40;
    }
    return form;
}

/// A form that is each of two: of both the middle, and what is left of either.
inline LinearForm either(const LinearForm& a, const LinearForm& b) {
    LinearForm form;
    for (int c = 0; c < 4; ++c) {
        form.at[c] = (a.at[c] + b.at[c]) / 2;
        double left_a = a.rest[c] + std::fabs(a.at[c] - form.at[c]);
        double left_b = b.rest[c] + std::fabs(b.at[c] - form.at[c]);
        double size = std::fabs(a.at[c]) + std::fabs(b.at[c]);
        for (int k = 0; k < 3; ++k) {
            form.part[k][c] = (a.part[k][c] + b.part[k][c]) / 2;
            left_a += std::fabs(a.part[k][c] - form.part[k][c]);
            left_b += std::fabs(b.part[k][c] - form.part[k][c]);
            size += std::fabs(a.part[k][c]) + std::fabs(b.part[k][c]);
        }
        form.rest[c] = std::max(left_a, left_b) * (1 + 0x1p-40) + size * 0x1p-40;
    }
    return form;
}

/// The greatest value that the form may have.
inline double greatest_of(const LinearForm& form, int channel) {
    double greatest = form.at[channel] + form.rest[channel];
    for (int k = 0; k < 3; ++k) greatest += std::fabs(form.part[k][channel]);
    return greatest;
}

/// The form as a number, with what filters are off by, and texels by `own`; `range` where the form
/// is wider.
inline Ranged narrower(const LinearForm& form, int channel, std::int32_t named,
                       const RealInterval& range, double own) {
    const ErrorBudget& errors = budget();
    double parts = 0;
    for (int k = 0; k < 3; ++k) parts += std::fabs(form.part[k][channel]);
    const double off = (errors.filtered + (errors.unit > 0 ? 4 * errors.unit : 0x1p-48)) *
                       (std::fabs(form.at[channel]) + parts + form.rest[channel]);
    const double rest = form.rest[channel] + off + own;
    if (!(2 * (rest + parts) <= 1.1 * range.width())) return Ranged(range);
    Ranged result(widened(form.at[channel], rest));
    result.mass = next_up(result.mass + parts);
    result.named = named;
    for (int k = 0; k < 3; ++k) result.part[k] = form.part[k][channel];
    return result;
}

}  // namespace quadrel::range_detail
