// prism-gs: rays end where they leave the prism, and meet what lies on the chord between.
#include "effort.hpp"
#include "quadrel/bake/bake.hpp"
#include "relief/shell/prism_oracle.hpp"
#include "render/draw/shell/prism_faces.hpp"

namespace quadrel::test {
namespace {

using oracle::Real;
using RealVec = std::array<Real, 3>;

/// What may be wrong with the rows of prisms.
enum class PrismFaceFlaw { none, turned_round, upside_down, other_diagonals };

RealVec minus(const RealVec& a, const RealVec& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
RealVec across(const RealVec& a, const RealVec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real along(const RealVec& a, const RealVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A prism's eight triangles as T. Moeller and B. Trumbore, "Fast, Minimum Storage Ray-Triangle
/// Intersection", 1997, meet them.
struct JudgedPrism {
    std::vector<PrismTriangle> faces;
    std::vector<std::array<RealVec, 3>> corners;

    struct Exit {
        Real t = -1;
        Real s = 0, margin = 0;  ///< how clearly the ray passes within the triangle
        bool bottom = false;
    };

    explicit JudgedPrism(const Shell& shell, const Mesh& mesh, const Material& material) {
        append_prism_faces(shell, mesh, material, {}, faces);
        for (const PrismTriangle& face : faces) {
            std::array<RealVec, 3> places;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3& at = shell.vertices().eye[face.index[k]];
                places[k] = {at.x, at.y, at.z};
            }
            corners.push_back(places);
        }
    }

    bool is_entered(std::size_t f) const {
        const auto& [a, b, c] = corners[f];
        return along(across(minus(b, a), minus(c, a)), a) < 0;
    }

    /// First of the faces from within, if it is clear which.
    Exit exit(const RealVec& P, const RealVec& d) const {
        Exit first;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            if (is_entered(f)) continue;
            const auto& [a, b, c] = corners[f];
            const RealVec e1 = minus(b, a), e2 = minus(c, a), h = across(d, e2);
            const Real det = along(e1, h);
            if (det == 0) continue;
            const RealVec to = minus(P, a), q = across(to, e1);
            const Real u = along(to, h) / det, v = along(d, q) / det, t = along(e2, q) / det;
            if (u < 0 || v < 0 || u + v > 1 || t < 0 || (first.t >= 0 && t >= first.t)) continue;
            const auto& s = faces[f].s;
            first = {t, s[0] + (s[1] - s[0]) * u + (s[2] - s[0]) * v, std::min({u, v, 1 - u - v}),
                     s[0] + s[1] + s[2] == 3};
        }
        return first;
    }
};

/// Rays over a level: met where the chord from entry to exit comes down to it.
testing::AssertionResult levels_are_met_on_chords(PrismFaceFlaw flaw, int batches) {
    int hits = 0, misses = 0;
    for (int i = 0; i < batches; ++i) {
        Random random(static_cast<std::uint64_t>(i) * 13 + 1);
        const float level = static_cast<float>(random.uniform(0, 1));
        const Map map = flat_map(level, 8);
        Batch<double> batch;
        batch.bind(TextureSlot::height, map.sampled);
        Material material;
        material.depth = batch.material.depth = static_cast<float>(random.uniform(0.02, 0.6));
        material.seat = batch.material.seat = static_cast<float>(random.below(3)) / 2;
        batch.primitives.resize(static_cast<std::size_t>(batch.lanes / 4));
        batch.vertices.resize(batch.primitives.size());
        std::vector<JudgedPrism> prisms;
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const auto q = static_cast<std::size_t>(quad);
            const Mesh mesh = random_prism_mesh(random);
            const Shell shell(mesh, shaded(mesh), material, glm::mat4(1.0f));
            prisms.emplace_back(shell, mesh, material);
            const JudgedPrism& prism = prisms.back();
            std::size_t f = 0;
            do f = static_cast<std::size_t>(random.below(8));
            while (!prism.is_entered(f));
            PrismTriangle triangle = prism.faces[f];
            PrismFace& face = triangle.face;
            if (flaw == PrismFaceFlaw::turned_round) face.turned = -face.turned;
            if (flaw == PrismFaceFlaw::upside_down) std::swap(face.bottom, face.top);
            if (flaw == PrismFaceFlaw::other_diagonals) {
                std::swap(face.bottom[0], face.bottom[1]);
                std::swap(face.top[0], face.top[1]);
                face.turned = -face.turned;
            }
            batch.vertices[q] = prism_row(triangle, whole_piece(), 8);
            batch.primitives[q] = {};
            for (float& w : batch.primitives[q].w) w = 1;
            for (int lane = 4 * quad; lane < 4 * quad + 4; ++lane) {
                const auto l = static_cast<std::size_t>(lane);
                const double a = random.uniform(0, 1), b = random.uniform(0, 1 - a);
                const double weight[3] = {a, b, 1 - a - b};
                RealVec P{};
                for (std::size_t k = 0; k < 3; ++k) {
                    batch.edges[k][l] = weight[k];
                    for (std::size_t c = 0; c < 3; ++c)
                        P[c] += prism.corners[f][k][c] * Real(weight[k]);
                }
                batch.primitive[l] = quad;
                batch.set(Value::P, lane, dvec3(double(P[0]), double(P[1]), double(P[2])));
                batch.set(Value::uv, lane, dvec2(0.25, 0.5));
                batch.set(Value::vertex_normal, lane, dvec3(0, 0, 1));
                for (const Value v : {Value::dPdx, Value::dPdy}) batch.set(v, lane, dvec3(0, 0, 0));
                for (const Value v : {Value::dUVdx, Value::dUVdy}) batch.set(v, lane, dvec2(0, 0));
            }
        }
        batch.run("frame-prism");
        batch.run("prism-gs", {{"steps", 4}, {"binary_steps", 50}});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto l = static_cast<std::size_t>(lane);
            const auto q = static_cast<std::size_t>(lane / 4);
            RealVec P, d;
            for (int c = 0; c < 3; ++c) P[std::size_t(c)] = batch.real(Value::P, lane, c);
            for (std::size_t c = 0; c < 3; ++c) d[c] = P[c] / std::sqrt(along(P, P));
            const JudgedPrism::Exit exit = prisms[q].exit(P, d);
            if (exit.t < 1e-4L || exit.margin < 1e-6L) continue;
            const PrismFace face = std::bit_cast<PrismFace>(batch.vertices[q]);
            Real s = 0;
            for (std::size_t k = 0; k < 3; ++k) s += Real(batch.edges[k][l]) * face.s[k];
            // Where height 1 - s comes down to the level, if it does.
            const Real part = (1 - s - level) / (exit.s - s);
            const bool starts_below = 1 - s <= level;
            if (!starts_below && std::fabs(part - 1) < 1e-5L) continue;
            if (std::fabs(1 - s - level) < 1e-5L) continue;
            const bool meets = starts_below || (part > 0 && part < 1) || exit.bottom;
            const Real expected = starts_below ? 0 : std::min<Real>(part, 1) * exit.t;
            const bool hit = batch.integer(Value::hit_status, lane) == int(Status::hit);
            const Real found = batch.real(Value::hit_depth, lane);
            hits += meets;
            misses += !meets;
            if (hit == meets && (!meets || std::fabs(found - expected) < 1e-5L * (1 + exit.t)))
                continue;
            return testing::AssertionFailure()
                   << "batch " << i << ", lane " << lane << ": " << (hit ? "met" : "missed")
                   << " at " << double(found) << " for " << (meets ? "" : "no ") << double(expected)
                   << " of " << double(exit.t) << ", s " << double(s) << " to " << double(exit.s)
                   << ", level " << level;
        }
    }
    if (hits > 50 && misses > 50) return testing::AssertionSuccess();
    return testing::AssertionFailure() << hits << " hits, " << misses << " misses";
}

TEST(PrismGs, LevelsAreMetOnChords) {
    EXPECT_TRUE(levels_are_met_on_chords(PrismFaceFlaw::none, rounds(20)));
    for (const PrismFaceFlaw flaw :
         {PrismFaceFlaw::turned_round, PrismFaceFlaw::upside_down, PrismFaceFlaw::other_diagonals})
        EXPECT_FALSE(levels_are_met_on_chords(flaw, 3)) << static_cast<int>(flaw);
}

/// J has the differences of u, v and the depth between a prism's corners, where they are exact: in
/// a prism over a plane, whose normals are parallel.
TEST(PrismGs, GradientsAreThoseOfThePrism) {
    Random random(9);
    for (int i = 0; i < 20; ++i) {
        Mesh mesh = random_prism_mesh(random);
        mesh.normals.assign(3, mesh.normals[0]);
        Material material;
        material.depth = 0.3f;
        const Shell shell(mesh, shaded(mesh), material, glm::mat4(1.0f));
        std::vector<PrismTriangle> faces;
        append_prism_faces(shell, mesh, material, {}, faces);
        Batch<double> batch(16);
        batch.material.depth = material.depth;
        batch.primitives.resize(1);
        for (float& w : batch.primitives[0].w) w = 1;
        batch.vertices = {prism_row(faces[0], whole_piece(), 8)};
        for (int lane = 0; lane < batch.lanes; ++lane) {
            for (auto& edge : batch.edges) edge[static_cast<std::size_t>(lane)] = 1.0 / 3;
            batch.set(Value::P, lane, dvec3(0, 0, -1));
            batch.set(Value::vertex_normal, lane, dvec3(0, 0, 1));
        }
        batch.run("frame-prism", {{"normal", 1}});
        for (std::size_t k = 1; k < 3; ++k) {
            const glm::dvec3 edge = mesh.positions[k] - mesh.positions[0];
            for (int axis = 0; axis < 2; ++axis) {
                double difference = 0;
                for (int c = 0; c < 3; ++c)
                    difference += batch.real(Value::J, 0, 3 * axis + c) * edge[c];
                EXPECT_NEAR(difference, double(mesh.uvs[k][axis]) - mesh.uvs[0][axis], 1e-5);
            }
        }
        const glm::dvec3 N = glm::normalize(glm::dvec3(mesh.normals[0]));
        double climb = 0;
        for (int c = 0; c < 3; ++c) climb += batch.real(Value::frame_normal, 0, c) * N[c];
        EXPECT_NEAR(climb, 1, 1e-5) << "depth over the shell's depth, along the normals";
    }
}

}  // namespace
}  // namespace quadrel::test
