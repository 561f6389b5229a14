// SPDX-License-Identifier: Apache-2.0
#include <preint/table_error.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <preint/table_reader.h>
#include <preint/table_texels.h>

namespace tetralux::preint {
namespace {

void composite(SegmentResult& sum, const SegmentResult& behind) {
    sum.color += sum.transmittance() * behind.color;
    sum.opticalDepth += behind.opticalDepth;
}

/// Quasi-random numbers in [0, 1): the additive recurrence of Roberts 2018 ("The unreasonable effectiveness of
/// quasirandom sequences") in four dimensions, dealt out one after the other.
class QuasiRandom {
public:
    double operator()() {
        if (dimension_ == dimensions) {
            dimension_ = 0;
            ++index_;
        }
        constexpr double root = 1.1673039782614187;  // of x⁵ = x + 1
        const double product = 0.5 + static_cast<double>(index_) * std::pow(root, -1.0 - dimension_++);
        return product - std::floor(product);
    }

private:
    static constexpr int dimensions = 4;
    int dimension_ = 0;
    unsigned index_ = 1;
};

struct Sampler {
    const ExactIntegral& exact;
    const PreintegrationTable& layout;
    double low, high;
    std::vector<double> nodes;
    QuasiRandom random;
    std::vector<SampleRay> rays;

    double inRange(double scalar) const { return std::clamp(scalar, low, high); }
    double randomScalar() { return std::lerp(low, high, random()); }
    double randomLength() { return layout.lengthMax * std::pow(10.0, -4.0 * random()); }
    /// ± the range times 10^−1 to 10^−4
    double randomStep() {
        const double magnitude = std::pow(10.0, -1.0 - 3.0 * random());
        return (random() < 0.5 ? -magnitude : magnitude) * (high - low);
    }

    void add(SampleRay ray) {
        for (std::size_t i = 0; i < ray.lengths.size(); ++i) {
            composite(ray.exact, exact.segment(ray.scalars[i], ray.scalars[i + 1], ray.lengths[i], layout.integral));
        }
        rays.push_back(std::move(ray));
    }
    void addSegment(double front, double back) { add({{inRange(front), inRange(back)}, {randomLength()}, {}}); }
    void addLongSegment(double front, double back) {
        add({{inRange(front), inRange(back)}, {layout.lengthMax * (0.3 + 0.7 * random())}, {}});
    }

    void addSegments() {
        constexpr int perKind = 400;
        for (int i = 0; i < perKind; ++i) {
            addSegment(randomScalar(), randomScalar());
            const double front = randomScalar();
            addSegment(front, front + randomStep());
            const double node = nodes[static_cast<std::size_t>(i) % nodes.size()] + randomStep();
            addLongSegment(node, node + randomStep());
            const double start = nodes[static_cast<std::size_t>(i) % nodes.size()] + randomStep();
            addSegment(start, randomScalar());
        }
    }

    /// Within and across neighbouring nodes so near to each other that chance hardly falls between them: nodes over
    /// many decades are.
    void addNarrowSegments() {
        constexpr double narrow = 1e-3;  // of the range
        constexpr int perPair = 40;
        std::vector<double> ascending = nodes;
        std::sort(ascending.begin(), ascending.end());
        for (std::size_t i = 0; i + 1 < ascending.size(); ++i) {
            const double begin = ascending[i], end = ascending[i + 1];
            if (!(end > begin) || end - begin > narrow * (high - low)) continue;
            for (int k = 0; k < perPair; ++k) {
                const double front = std::lerp(begin, end, random()), back = std::lerp(begin, end, random());
                if (k % 2 == 0)
                    addSegment(front, back);
                else
                    addLongSegment(front, k % 4 == 1 ? back : std::lerp(begin, 2.0 * end - begin, random()));
            }
        }
    }

    /// A ray whose scalar follows `path` of [0, 1]; steps and lengths vary at random.
    void addRay(int steps, const std::function<double(double)>& path) {
        SampleRay ray;
        const double stride = layout.lengthMax * std::pow(10.0, -2.0 * random());
        double total = 0.0;
        std::vector<double> at{0.0};
        for (int i = 0; i < steps; ++i) at.push_back(total += random() + 0.01);
        for (const double t : at) ray.scalars.push_back(inRange(path(t / total)));
        for (int i = 0; i < steps; ++i) ray.lengths.push_back(stride * random());
        add(std::move(ray));
    }

    void addRays() {
        constexpr int stepCounts[] = {30, 100, 400};
        for (int i = 0; i < 12; ++i) {
            const int steps = stepCounts[i % 3];
            addRay(steps, [&](double t) { return std::lerp(low, high, i % 2 == 0 ? t : 1.0 - t); });
            const double middle = randomScalar(), amplitude = (high - low) * (0.05 + 0.45 * random()),
                         turns = 0.5 + 4.0 * random();
            addRay(steps, [=](double t) { return middle + amplitude * std::sin(2.0 * std::numbers::pi * turns * t); });
            const double from = randomScalar(), to = randomScalar();
            addRay(steps, [=](double t) { return std::lerp(from, to, t); });
        }
    }
};

double differenceOf(const SegmentResult& found, const SampleRay& ray, Compared compared) {
    const SegmentResult& exact = ray.exact;
    constexpr double faintest = 1e-30;
    const bool mean = compared == Compared::MeanColor;
    if (mean && (ray.lengths.size() > 1 || exact.opacity() < faintest)) return 0;
    const glm::dvec3 color = mean ? found.color / std::max(found.opacity(), faintest) - exact.color / exact.opacity()
                                  : found.color - exact.color;
    const double opacity = mean ? 0 : found.opacity() - exact.opacity();
    return std::max({std::abs(color.x), std::abs(color.y), std::abs(color.z), std::abs(opacity)});
}

template <class Fetch>
double largestError(const PreintegrationTable& table, const Fetch& fetch, const std::vector<SampleRay>& rays,
                    Compared compared) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, rays.size()), 0.0,
        [&](const tbb::blocked_range<std::size_t>& range, double largest) {
            TableReader<Fetch> reader(table, fetch);
            for (std::size_t r = range.begin(); r < range.end(); ++r) {
                const SampleRay& ray = rays[r];
                SegmentResult sum;
                for (std::size_t i = 0; i < ray.lengths.size(); ++i) {
                    composite(sum, reader.segment(ray.scalars[i], ray.scalars[i + 1], ray.lengths[i]));
                }
                largest = std::max(largest, differenceOf(sum, ray, compared));
            }
            return largest;
        },
        [](double a, double b) { return std::max(a, b); });
}

}  // namespace

std::vector<SampleRay> sampleRays(const ExactIntegral& exact, const PreintegrationTable& layout) {
    const double low = layout.zones.front().x, high = layout.zones.back().y;
    Sampler sampler{exact, layout, low, high, {}, {}, {}};
    for (const ColorNode& node : exact.function().color) sampler.nodes.push_back(node.scalar);
    for (const ExtinctionNode& node : exact.function().extinction) sampler.nodes.push_back(node.scalar);
    for (const Discontinuity& one : layout.discontinuities) sampler.nodes.push_back(one.value);
    std::erase_if(sampler.nodes, [&](double scalar) { return scalar < low || scalar > high; });
    if (sampler.nodes.empty()) sampler.nodes.push_back(0.5 * (low + high));
    sampler.addSegments();
    sampler.addNarrowSegments();
    sampler.addRays();
    return std::move(sampler.rays);
}

double lookUpError(const PreintegrationTable& table, const std::vector<SampleRay>& rays, Compared compared) {
    const int rows = table.size * static_cast<int>(table.zones.size());
    const auto fetch = [&table, rows](int i, int row, int k) {
        return glm::dvec4(table.texels[(static_cast<std::size_t>(k) * rows + row) * table.size + i]);
    };
    return largestError(table, fetch, rays, compared);
}

double lookUpError(const ExactIntegral& exact, const PreintegrationTable& layout, const std::vector<SampleRay>& rays,
                   Compared compared) {
    const TableTexels texels(exact, layout);
    const auto fetch = [&texels](int i, int row, int k) { return glm::dvec4(texels.texel(i, row, k)); };
    return largestError(layout, fetch, rays, compared);
}

}  // namespace tetralux::preint
