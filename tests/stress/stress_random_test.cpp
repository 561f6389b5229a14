// SPDX-License-Identifier: Apache-2.0
// Random scenes where floats have least room (random_numerics.h): what an engine cannot vouch for it must know. Every
// pixel of cpu and gl is the reference's to 1e-4. TETRALUX_RANDOM_SCENES=N tries N scenes instead of a few seconds'
// worth; TETRALUX_RANDOM_SEED=K begins at scene K.
#include <cstdlib>

#include <tests/stress/engine_cases.h>
#include <tests/stress/random_numerics.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

constexpr double largestError = 1e-4;

unsigned setting(const char* name, unsigned usual) {
    const char* text = std::getenv(name);
    return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : usual;
}

/// The largest difference of a channel, relative to what is above 1 (light that adds up).
double largestDifference(const Image& image, const Image& expected) {
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel) {
            const double found = static_cast<double>(image.pixels[i][channel]),
                         wanted = static_cast<double>(expected.pixels[i][channel]);
            const double error = std::abs(found - wanted) / std::max(1.0, std::abs(wanted));
            largest = std::isfinite(error) ? std::max(largest, error) : HUGE_VAL;
        }
    return largest;
}

TEST(StressRandom, EveryPixelIsTheReferencesOrKnownNotToBe) {
    const unsigned first = setting("TETRALUX_RANDOM_SEED", 1), count = setting("TETRALUX_RANDOM_SCENES", 40);
    std::uint64_t repaired = 0, pixels = 0;
    for (unsigned seed = first; seed < first + count; ++seed) {
        RandomScene random = RandomNumerics(seed).scene();
        SCOPED_TRACE(fmt::format("scene {}: {}", seed, random.what));
        FrameReport report;
        const Image expected = makeEngine(random.scene, {.engine = "reference"})->render(random.camera, report);
        for (const auto& options : enginesUnderTest()) {
            if (options.engine == "reference") continue;
            FrameReport frame;
            const Image image = makeEngine(random.scene, options)->render(random.camera, frame);
            repaired += frame.pixelsRepaired;
            pixels += image.pixels.size();
            if (frame.pixelsWrong > 0) continue;
            EXPECT_LE(largestDifference(image, expected), largestError)
                << options.engine << ", scene " << seed << ": " << random.what << ", repaired " << frame.pixelsRepaired;
        }
    }
    std::printf("%u scenes, %.3f of the pixels repaired\n", count,
                static_cast<double>(repaired) / static_cast<double>(pixels));
}

}  // namespace
}  // namespace tetralux::projection
