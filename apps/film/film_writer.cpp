// SPDX-License-Identifier: Apache-2.0
#include <apps/film/film_writer.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <projection/image/whole_file.h>

namespace tetralux::apps {

namespace {

namespace fs = std::filesystem;

std::string ending(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool hasFfmpeg() {
    const char* const path = std::getenv("PATH");
    for (std::string_view folders = path != nullptr ? path : ""; !folders.empty();) {
        const std::size_t colon = folders.find(':');
        const std::string program = std::string(folders.substr(0, colon)) + "/ffmpeg";
        if (::access(program.c_str(), X_OK) == 0) return true;
        folders = colon == std::string_view::npos ? std::string_view() : folders.substr(colon + 1);
    }
    return false;
}

std::vector<std::string> commandLine(const std::string& output, int width, int height, double framesPerSecond) {
    std::vector<std::string> words{"ffmpeg",
                                   "-hide_banner",
                                   "-loglevel",
                                   "error",
                                   "-y",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "rgb24",
                                   "-s",
                                   fmt::format("{}x{}", width, height),
                                   "-r",
                                   fmt::format("{}", framesPerSecond),
                                   "-i",
                                   "-"};
    if (ending(output) == ".gif") {
        for (const char* word : {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"})
            words.emplace_back(word);
    } else {  // every player takes even sizes in 4:2:0
        for (const char* word : {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"})
            words.emplace_back(word);
        if (ending(output) == ".mp4" || ending(output) == ".mov")
            for (const char* word : {"-crf", "18", "-movflags", "+faststart"}) words.emplace_back(word);
    }
    words.push_back(output);
    return words;
}

std::string lastLine(const std::string& path) {
    std::ifstream file(path);
    std::string last = "none";
    for (std::string line; std::getline(file, line);)
        if (!line.empty()) last = line;
    return last;
}

}  // namespace

bool isFilm(const std::string& path) {
    static constexpr std::array films{".mp4", ".mov", ".mkv", ".webm", ".avi", ".gif"};
    return std::find(films.begin(), films.end(), ending(path)) != films.end();
}

void checkFilm(const std::string& path) {
    if (!hasFfmpeg())
        throw std::runtime_error(
            fmt::format("{}: films are made by ffmpeg, which is not installed; install it (apt-get install ffmpeg), or "
                        "give OUT.png for "
                        "single pictures",
                        path));
    projection::checkWritable(path);
}

FilmWriter::FilmWriter(const std::string& path, int width, int height, double framesPerSecond) : path_(path) {
    const fs::path name(path);
    const std::string stem = fmt::format("{}.{}.part", name.stem().string(), ::getpid());
    unfinished_ = (name.parent_path() / (stem + name.extension().string())).string();
    log_ = (name.parent_path() / (stem + ".log")).string();
    std::signal(SIGPIPE, SIG_IGN);  // an encoder that ends early is an error to tell, not our end
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error(
            fmt::format("{}: no pipe to ffmpeg ({}); close other programs", path, std::strerror(errno)));
    std::vector<std::string> words = commandLine(unfinished_, width, height, framesPerSecond);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int error = posix_spawnp(&child_, "ffmpeg", &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(ends[0]);
    pipe_ = ends[1];
    if (error != 0) {
        child_ = -1;
        end();
        throw std::runtime_error(fmt::format("{}: ffmpeg cannot be started ({})", path, std::strerror(error)));
    }
}

FilmWriter::~FilmWriter() {
    if (child_ > 0) {
        ::kill(child_, SIGTERM);
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    end();
}

/// Closes the pipe and removes what is not the film.
void FilmWriter::end() {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
    std::error_code ignored;
    fs::remove(unfinished_, ignored);
    fs::remove(log_, ignored);
}

void FilmWriter::add(const projection::Image& image) {
    projection::requireFinite(image, path_);
    std::vector<unsigned char> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            bytes.push_back(static_cast<unsigned char>(std::lround(255.0f * std::clamp(pixel[channel], 0.0f, 1.0f))));
    const unsigned char* at = bytes.data();
    for (std::size_t left = bytes.size(); left > 0;) {
        const ssize_t written = ::write(pipe_, at, left);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0)
            throw std::runtime_error(
                fmt::format("{}: ffmpeg ended before the film did; its last words: {}", path_, lastLine(log_)));
        at += written;
        left -= static_cast<std::size_t>(written);
    }
}

void FilmWriter::finish() {
    ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(
            fmt::format("{}: ffmpeg could not make it; its last words: {}", path_, lastLine(log_)));
    std::error_code failed;
    fs::rename(unfinished_, path_, failed);
    if (failed) throw std::runtime_error(fmt::format("{}: cannot be written ({})", path_, failed.message()));
}

}  // namespace tetralux::apps
