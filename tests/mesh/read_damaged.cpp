// SPDX-License-Identifier: Apache-2.0
//
// read_damaged [--copies N] [--seed N] [--limit SECONDS] [--budget SECONDS] FILE...
//
// Makes N (1000) files of random bytes, N truncated and N bit-flipped copies of each FILE, reads each in a process of
// its own and prints, for each kind, how many were read, refused, crashed the reader or took longer than the limit.
// Copy i of a kind has the seed `seed + i`. What lies beside FILE is there too, whole, so that files that name others
// can be read. A kind ends early after its share of the budget, and says so. A crash or hang is printed with its seed
// and makes the exit status 1.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

#include "damage.h"

namespace {

using namespace tetralux::mesh::test;
using Clock = std::chrono::steady_clock;

struct Options {
    std::uint64_t copies = 1000, seed = 1;
    std::chrono::seconds limit{60}, budget{600};
    std::vector<std::filesystem::path> files;
};

Options parse(int count, char** arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const auto number = [&] { return i + 1 < count ? std::strtoull(arguments[++i], nullptr, 10) : 0ull; };
        const std::string argument = arguments[i];
        if (argument == "--copies") {
            options.copies = number();
        } else if (argument == "--seed") {
            options.seed = number();
        } else if (argument == "--limit") {
            options.limit = std::chrono::seconds(number());
        } else if (argument == "--budget") {
            options.budget = std::chrono::seconds(number());
        } else {
            options.files.emplace_back(argument);
        }
    }
    return options;
}

/// A folder with links to everything beside `file`.
class Neighbourhood {
public:
    explicit Neighbourhood(const std::filesystem::path& file) {
        std::string pattern = (std::filesystem::temp_directory_path() / "tetralux-damage-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::absolute(file).parent_path())) {
            std::filesystem::create_symlink(entry.path(), folder_ / entry.path().filename());
        }
    }
    Neighbourhood(const Neighbourhood&) = delete;
    Neighbourhood& operator=(const Neighbourhood&) = delete;
    ~Neighbourhood() { std::filesystem::remove_all(folder_); }
    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

/// The file to open so that `file` is read.
std::filesystem::path sourceFor(const std::filesystem::path& file) {
    std::filesystem::path source = file;
    if (file.extension() == ".sol") {
        source.replace_extension(".mesh");
    }
    return source;
}

bool isBad(ReadingEnd end) {
    return end == ReadingEnd::Crash || end == ReadingEnd::Hang;
}

bool damageOne(const Options& options, const std::filesystem::path& file, const Neighbourhood& around, Damage damage) {
    const std::string whole = wholeFile(file);
    const std::filesystem::path copy = around.folder() / file.filename();
    std::map<ReadingEnd, std::uint64_t> tally;
    const auto start = Clock::now();
    std::uint64_t done = 0;
    for (; done < options.copies && Clock::now() - start < options.budget / 3; ++done) {
        writeFile(copy, damagedCopy(whole, damage, options.seed + done));
        const ReadingEnd end = readInChild(sourceFor(copy).string(), options.limit);
        ++tally[end];
        if (isBad(end)) {
            fmt::print("{}: {} with seed {}: {}\n", file.string(), damageName(damage), options.seed + done,
                       end == ReadingEnd::Crash ? "CRASH" : "HANG");
            std::fflush(stdout);
        }
    }
    fmt::print("{}: {}, seeds {} to {}: {} read, {} refused, {} crashed, {} hung, {:.1f} s{}\n", file.string(),
               damageName(damage), options.seed, options.seed + done - 1, tally[ReadingEnd::Mesh],
               tally[ReadingEnd::Refusal], tally[ReadingEnd::Crash], tally[ReadingEnd::Hang],
               std::chrono::duration<double>(Clock::now() - start).count(), done < options.copies ? " (budget)" : "");
    std::fflush(stdout);
    return tally[ReadingEnd::Crash] + tally[ReadingEnd::Hang] == 0;
}

}  // namespace

int main(int count, char** arguments) {
    const Options options = parse(count, arguments);
    if (options.files.empty() || options.copies == 0) {
        std::fputs("read_damaged [--copies N] [--seed N] [--limit SECONDS] [--budget SECONDS] FILE...\n", stderr);
        return 2;
    }
    bool good = true;
    for (const std::filesystem::path& file : options.files) {
        const Neighbourhood around(file);
        for (const Damage damage : damages) {
            good = damageOne(options, file, around, damage) && good;
        }
    }
    return good ? 0 : 1;
}
