// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/procedural_field.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <glm/geometric.hpp>

namespace tetralux::mesh {
namespace {

constexpr double pi = std::numbers::pi;
using Atoms = std::array<glm::dvec3, 60>;

/// Grid point (i, j, k) of n×n×n over `box`; the ends are the box's corners exactly.
glm::dvec3 gridPoint(const BoundingBox& box, int n, int i, int j, int k) {
    const glm::dvec3 t = glm::dvec3(i, j, k) / static_cast<double>(n - 1);
    return box.low + t * (box.high - box.low);
}

/// The 60 atoms of C60: even permutations of (0, ±1, ±3φ), (±1, ±(2+φ), ±2φ), (±φ, ±2, ±(2φ+1)), scaled to a
/// circumradius of 0.4 about the centre of the unit cube.
Atoms fullereneAtoms() {
    constexpr double phi = std::numbers::phi;
    const std::array<glm::dvec3, 3> corners{
        {{0.0, 1.0, 3.0 * phi}, {1.0, 2.0 + phi, 2.0 * phi}, {phi, 2.0, 2.0 * phi + 1.0}}};
    Atoms atoms;
    std::size_t count = 0;
    for (const glm::dvec3& corner : corners) {
        for (int signs = 0; signs < 8; ++signs) {
            if (corner.x == 0.0 && (signs & 1) != 0) {
                continue;  // −0 is the same point
            }
            const glm::dvec3 p(signs & 1 ? -corner.x : corner.x, signs & 2 ? -corner.y : corner.y,
                               signs & 4 ? -corner.z : corner.z);
            for (const glm::dvec3& q : {p, glm::dvec3(p.y, p.z, p.x), glm::dvec3(p.z, p.x, p.y)}) {
                atoms[count++] = glm::dvec3(0.5) + 0.4 * glm::normalize(q);
            }
        }
    }
    return atoms;
}

/// Σ exp(−|x − a|²/(2·0.05²)) over the atoms.
double fullereneSum(const Atoms& atoms, const glm::dvec3& x) {
    double sum = 0.0;
    for (const glm::dvec3& a : atoms) {
        const glm::dvec3 r = x - a;
        sum += std::exp(-glm::dot(r, r) / (2.0 * 0.05 * 0.05));
    }
    return sum;
}

double largestOnGrid(const BoundingBox& box, int n, const std::function<double(const glm::dvec3&)>& value) {
    return tbb::parallel_reduce(
        tbb::blocked_range<int>(0, n), 0.0,
        [&](const tbb::blocked_range<int>& layers, double largest) {
            for (int k = layers.begin(); k != layers.end(); ++k) {
                for (int j = 0; j < n; ++j) {
                    for (int i = 0; i < n; ++i) {
                        largest = std::max(largest, value(gridPoint(box, n, i, j, k)));
                    }
                }
            }
            return largest;
        },
        [](double a, double b) { return std::max(a, b); });
}

/// C60 as the sum of 60 Gaussians over its largest value at the points of an n×n×n grid.
ProceduralField buckyField(int n) {
    ProceduralField field{"bucky", "density", {glm::dvec3(0.0), glm::dvec3(1.0)}, {}, {}};
    const Atoms atoms = fullereneAtoms();
    const double largest = largestOnGrid(field.domain, n, [&](const glm::dvec3& x) { return fullereneSum(atoms, x); });
    field.value = [atoms, largest](const glm::dvec3& x) { return fullereneSum(atoms, x) / largest; };
    field.gradient = [atoms, largest](const glm::dvec3& x) {
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& a : atoms) {
            const glm::dvec3 r = x - a;
            sum -= r * (std::exp(-glm::dot(r, r) / (2.0 * 0.05 * 0.05)) / (0.05 * 0.05));
        }
        return sum / largest;
    };
    return field;
}

/// Three Coulomb potentials as in Kraus 2005, Figure 1: one charge above and two smaller ones below. The paper
/// gives no numbers; these are ours. Each potential is q/√(|x − p|² + ε²), softened so that it stays finite.
ProceduralField coulombField(int) {
    struct Charge {
        glm::dvec3 position;
        double q;
    };
    static constexpr double softening = 0.05;
    static const std::array<Charge, 3> charges{
        {{{0.5, 0.7, 0.5}, 1.0}, {{0.3, 0.3, 0.5}, 0.5}, {{0.7, 0.3, 0.5}, 0.5}}};
    ProceduralField field{"coulomb", "potential", {glm::dvec3(0.0), glm::dvec3(1.0)}, {}, {}};
    field.value = [](const glm::dvec3& x) {
        double sum = 0.0;
        for (const Charge& c : charges) {
            const glm::dvec3 r = x - c.position;
            sum += c.q / std::sqrt(glm::dot(r, r) + softening * softening);
        }
        return sum;
    };
    field.gradient = [](const glm::dvec3& x) {
        glm::dvec3 sum(0.0);
        for (const Charge& c : charges) {
            const glm::dvec3 r = x - c.position;
            const double squared = glm::dot(r, r) + softening * softening;
            sum -= r * (c.q / (squared * std::sqrt(squared)));
        }
        return sum;
    };
    return field;
}

/// Marschner & Lobb 1994, Section 5, with its parameters f_M = 6 and α = 0.25 on [−1, 1]³:
/// ρ = (1 − sin(πz/2) + α(1 + ρ_r(√(x² + y²)))) / (2(1 + α)), ρ_r(r) = cos(2π f_M cos(πr/2)).
ProceduralField marschnerLobbField(int) {
    static constexpr double frequency = 6.0;
    static constexpr double alpha = 0.25;
    ProceduralField field{"marschner-lobb", "signal", {glm::dvec3(-1.0), glm::dvec3(1.0)}, {}, {}};
    field.value = [](const glm::dvec3& x) {
        const double r = std::hypot(x.x, x.y);
        const double wave = std::cos(2.0 * pi * frequency * std::cos(0.5 * pi * r));
        return (1.0 - std::sin(0.5 * pi * x.z) + alpha * (1.0 + wave)) / (2.0 * (1.0 + alpha));
    };
    field.gradient = [](const glm::dvec3& x) {
        const double r = std::hypot(x.x, x.y);
        const double scale = 1.0 / (2.0 * (1.0 + alpha));
        // dρ_r/dr divided by r; sin(πr/2)/r tends to π/2 on the axis.
        const double sineOverR = r > 0.0 ? std::sin(0.5 * pi * r) / r : 0.5 * pi;
        const double radial = std::sin(2.0 * pi * frequency * std::cos(0.5 * pi * r)) * pi * pi * frequency * sineOverR;
        return scale * glm::dvec3(alpha * radial * x.x, alpha * radial * x.y, -0.5 * pi * std::cos(0.5 * pi * x.z));
    };
    return field;
}

/// Amplitude of the 3d_z² orbital over its largest magnitude, which stands at z = ±6 a₀ on the axis:
/// ψ = (3z² − r²) exp(−r/3) / (72 exp(−2)), lengths in Bohr radii a₀.
double orbitalAmplitude(const glm::dvec3& x) {
    const double r = glm::length(x);
    return (3.0 * x.z * x.z - r * r) * std::exp(2.0 - r / 3.0) / 72.0;
}

/// Hydrogen's 3d_z² orbital: the probability density |ψ|² over its largest value, so from 0 to 1 (on the axis at
/// |z| = 6), within 20 Bohr radii of the nucleus along each axis.
ProceduralField hydrogenField(int) {
    ProceduralField field{"hydrogen", "probability", {glm::dvec3(-20.0), glm::dvec3(20.0)}, {}, {}};
    field.value = [](const glm::dvec3& x) {
        const double amplitude = orbitalAmplitude(x);
        return amplitude * amplitude;
    };
    field.gradient = [](const glm::dvec3& x) {
        const double r = glm::length(x);
        if (r == 0.0) {
            return glm::dvec3(0.0);
        }
        const double decay = std::exp(2.0 - r / 3.0) / 72.0;
        const glm::dvec3 polynomial(-2.0 * x.x, -2.0 * x.y, 4.0 * x.z);
        const glm::dvec3 amplitudeGradient = decay * polynomial - orbitalAmplitude(x) / (3.0 * r) * x;
        return 2.0 * orbitalAmplitude(x) * amplitudeGradient;
    };
    return field;
}

struct Generator {
    const char* name;
    ProceduralField (*make)(int n);
};
constexpr std::array<Generator, 4> generators{{{"bucky", buckyField},
                                               {"coulomb", coulombField},
                                               {"marschner-lobb", marschnerLobbField},
                                               {"hydrogen", hydrogenField}}};

void checkGridSize(const std::string& name, int n) {
    if (n < 2 || n > 1000) {
        throw std::runtime_error(fmt::format(
            "{}:{}: a generated mesh has 2 to 1000 points per edge; give a size such as {}:32", name, n, name));
    }
    const double edge = n - 1;
    if (5.0 * edge * edge * edge >= 4294967295.0) {
        throw std::runtime_error(
            fmt::format("{}:{}: more cells than can be numbered; take at most 951 points per edge", name, n));
    }
}

/// The five tetrahedra of cube (i, j, k). The inner one has the corners whose i + j + k is even, so that cubes of
/// either parity cut their shared face along the same diagonal.
void splitCube(int n, int i, int j, int k, Tetrahedron* out) {
    const auto corner = [&](int bits) {
        const std::size_t x = static_cast<std::size_t>(i + (bits & 1));
        const std::size_t y = static_cast<std::size_t>(j + ((bits >> 1) & 1));
        const std::size_t z = static_cast<std::size_t>(k + (bits >> 2));
        const std::size_t edge = static_cast<std::size_t>(n);
        return static_cast<PointIndex>(x + edge * (y + edge * z));
    };
    static constexpr std::array<int, 4> evenCorners{0, 3, 6, 5};  // bits zyx: 000 011 110 101
    static constexpr std::array<int, 4> oddCorners{1, 2, 4, 7};   // bits zyx: 001 010 100 111
    const bool even = ((i + j + k) & 1) == 0;
    const auto& inner = even ? evenCorners : oddCorners;
    const auto& tips = even ? oddCorners : evenCorners;
    *out++ = {corner(inner[0]), corner(inner[1]), corner(inner[2]), corner(inner[3])};
    for (const int tip : tips) {
        // Edges along x, y, z from an odd corner form a left-handed system: exchange two.
        const int first = even ? tip ^ 2 : tip ^ 1;
        const int second = even ? tip ^ 1 : tip ^ 2;
        *out++ = {corner(tip), corner(first), corner(second), corner(tip ^ 4)};
    }
}

}  // namespace

ProceduralField proceduralField(const std::string& name, int n) {
    for (const Generator& generator : generators) {
        if (name == generator.name) {
            checkGridSize(name, n);
            return generator.make(n);
        }
    }
    throw std::runtime_error(fmt::format("{}: no generated field of that name; there are {}", name,
                                         fmt::join(proceduralFieldNames(), ", ")));
}

TetMesh sampleOnGrid(const ProceduralField& field, int n) {
    checkGridSize(field.name, n);
    const std::size_t edge = static_cast<std::size_t>(n);
    TetMesh mesh;
    mesh.positions.resize(edge * edge * edge);
    mesh.cells.resize(5 * (edge - 1) * (edge - 1) * (edge - 1));
    Field scalars;
    scalars.name = field.fieldName;
    scalars.values.resize(mesh.positions.size());
    tbb::parallel_for(0, n, [&](int k) {
        std::size_t point = edge * edge * static_cast<std::size_t>(k);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i, ++point) {
                mesh.positions[point] = gridPoint(field.domain, n, i, j, k);
                scalars.values[point] = field.value(mesh.positions[point]);
            }
        }
    });
    tbb::parallel_for(0, n - 1, [&](int k) {
        Tetrahedron* out = mesh.cells.data() + 5 * (edge - 1) * (edge - 1) * static_cast<std::size_t>(k);
        for (int j = 0; j < n - 1; ++j) {
            for (int i = 0; i < n - 1; ++i, out += 5) {
                splitCube(n, i, j, k, out);
            }
        }
    });
    mesh.fields.push_back(std::move(scalars));
    return mesh;
}

std::optional<ProceduralSource> parseProceduralSource(const std::string& source) {
    for (const Generator& generator : generators) {
        const std::string prefix = std::string(generator.name) + ":";
        if (!source.starts_with(prefix)) {
            continue;
        }
        int n = 0;
        const char* const end = source.data() + source.size();
        const auto [stop, error] = std::from_chars(source.data() + prefix.size(), end, n);
        if (error == std::errc() && stop == end) {
            return ProceduralSource{generator.name, n};
        }
    }
    return std::nullopt;
}

std::vector<std::string> proceduralFieldNames() {
    std::vector<std::string> names;
    for (const Generator& generator : generators) {
        names.emplace_back(generator.name);
    }
    return names;
}

}  // namespace tetralux::mesh
