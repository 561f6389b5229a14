// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/image/image_codecs.h>

namespace tetralux::projection {

namespace {

constexpr const char* channelNames[4] = {"R", "G", "B", "A"};

/// OpenEXR writes here rather than to a file of its own: its destructor would swallow the error of a full disk.
class MemoryOutput final : public Imf::OStream {
public:
    explicit MemoryOutput(const std::string& name) : Imf::OStream(name.c_str()) {}
    void write(const char text[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ + size > bytes.size()) bytes.resize(position_ + size);
        std::memcpy(bytes.data() + position_, text, size);
        position_ += size;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::string bytes;

private:
    std::size_t position_ = 0;
};

class MemoryInput final : public Imf::IStream {
public:
    MemoryInput(const std::string& bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}
    bool read(char text[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ > bytes_.size() || size > bytes_.size() - position_)
            throw std::runtime_error("the file ends early");
        std::memcpy(text, bytes_.data() + position_, size);
        position_ += size;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    const std::string& bytes_;
    std::size_t position_ = 0;
};

/// Slices of `pixels` (width pixels a row) for the window whose first pixel is (left, top).
Imf::FrameBuffer frameBuffer(const glm::vec4* pixels, int width, int left, int top) {
    constexpr std::size_t pixelStride = sizeof(glm::vec4);
    const std::size_t rowStride = pixelStride * static_cast<std::size_t>(width);
    Imf::FrameBuffer buffer;
    for (int channel = 0; channel < 4; ++channel) {
        // Slice::Make shifts the base to the data window's origin without overflow.
        buffer.insert(channelNames[channel],
                      Imf::Slice::Make(Imf::FLOAT, &(*pixels)[channel], Imath::V2i(left, top), width, 1, pixelStride,
                                       rowStride, 1, 1, channel == 3 ? 1.0 : 0.0));
    }
    return buffer;
}

}  // namespace

std::string encodeExr(const Image& image, const std::string& name, const PngOutput& /*ignored*/) {
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const char* channel : channelNames) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        MemoryOutput stream(name);
        {
            Imf::OutputFile file(stream, header);
            file.setFrameBuffer(frameBuffer(image.pixels.data(), image.width, 0, 0));
            file.writePixels(image.height);
        }
        return std::move(stream.bytes);
    } catch (const std::exception& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be encoded as EXR ({}); choose a smaller size", name, error.what()));
    }
}

Image decodeExr(const std::string& bytes, const std::string& name) {
    try {
        MemoryInput stream(bytes, name);
        Imf::InputFile file(stream);
        const Imath::Box2i window = file.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        if (width < 1 || height < 1 || width > 65536 || height > 65536 || width * height > (std::int64_t{1} << 28))
            throw std::runtime_error(fmt::format("its size is {}x{}", width, height));
        if (file.header().channels().findChannel("R") == nullptr) throw std::runtime_error("it has no channel R");
        Image image(static_cast<int>(width), static_cast<int>(height));
        file.setFrameBuffer(frameBuffer(image.pixels.data(), image.width, window.min.x, window.min.y));
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& error) {
        const std::string why = error.what();
        throw std::runtime_error(fmt::format("{}: is not a readable EXR ({}); give a whole .png or .exr file", name,
                                             why.substr(0, why.find('\n'))));
    }
}

}  // namespace tetralux::projection
