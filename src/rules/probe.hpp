// What can be asked of an implementation: small shaders that make its choices visible, each beside
// Quadrel's own code on the same input.
#pragma once

#include "rules/ask/question.hpp"

namespace quadrel::rules {

struct Probe {
    std::string id;
    std::string asks;     ///< what is asked, in a line
    std::string permits;  ///< what the specification leaves open, and where it says so
    Question question{};
    /// Why presets that are named after a renderer do not claim to do as it does; empty: they do.
    std::string not_modelled{};
    double tolerance = 0;  ///< between the same answers; 0: the same bits, all NaNs as one
    /// Answers in few words.
    std::function<std::string(const Values&)> words{};
    /// Whether the specification permits these answers; none: anything, or nothing is known.
    std::function<bool(const Values&)> legal{};
    /// What is asked is no shader over triangles but where the samples of a pixel lie.
    bool by_samples = false;
    /// In place of the question, where there is none.
    std::function<Values(const HardwareModel&)> model{};
};

/// How the quad is made up, and derivatives over it.
std::vector<Probe> quad_probes();
/// Which samples a triangle covers, and what it has there.
std::vector<Probe> coverage_probes();
/// Levels of detail.
std::vector<Probe> level_probes();
/// Texels and their weights.
std::vector<Probe> texel_probes();
std::vector<Probe> cube_probes();
/// Floating-point numbers.
std::vector<Probe> number_probes();

std::vector<Probe> all_probes();

Values answers_of_quadrel(const Probe& probe, const HardwareModel& hardware);

/// How many answers differ by more than the tolerance; all where there are more of one than of the
/// other.
std::size_t differing(const Probe& probe, const Values& a, const Values& b);

}  // namespace quadrel::rules
