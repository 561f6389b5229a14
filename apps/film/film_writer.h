// SPDX-License-Identifier: Apache-2.0
/// \file
/// Films, encoded by ffmpeg where it is installed: pictures go to it through a pipe, none to disk.
#pragma once

#include <string>

#include <sys/types.h>

#include <projection/image/image.h>

namespace tetralux::apps {

/// Whether the name ends as a film's does: .mp4 .mov .mkv .webm .avi .gif
bool isFilm(const std::string& path);

/// \throws std::runtime_error where there is no ffmpeg, or the file could not be written.
void checkFilm(const std::string& path);

class FilmWriter {
public:
    /// Starts ffmpeg. \throws std::runtime_error
    FilmWriter(const std::string& path, int width, int height, double framesPerSecond);
    /// Without finish() nothing is left behind.
    ~FilmWriter();
    FilmWriter(const FilmWriter&) = delete;
    FilmWriter& operator=(const FilmWriter&) = delete;

    /// The next picture, over black where it is not opaque. \throws std::runtime_error when ffmpeg has ended.
    void add(const projection::Image& image);
    /// Waits for ffmpeg and puts the film where it belongs. \throws std::runtime_error with ffmpeg's last words.
    void finish();

private:
    void end();

    std::string path_, unfinished_, log_;
    int pipe_ = -1;
    pid_t child_ = -1;
};

}  // namespace tetralux::apps
