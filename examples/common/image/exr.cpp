// SPDX-License-Identifier: MIT
#include "common/image/exr.hpp"

#include "common/image/file.hpp"

#include <stdexcept>
#include <string>

#if defined(NEPHROID_EXAMPLES_HAS_OPENEXR)

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

namespace nephroid::examples {

namespace {

/// OpenEXR's output in memory, so that only `write_file` touches the disk.
class MemoryStream final : public Imf::OStream {
public:
    MemoryStream() : OStream("memory") {}

    void write(const char* data, int size) override {
        const std::size_t end = position_ + static_cast<std::size_t>(size);
        if (end > bytes_.size())
            bytes_.resize(end);
        std::copy_n(data, size, bytes_.data() + position_); // it goes back to fill in its table of offsets
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::size_t position_ = 0;
};

[[nodiscard]] std::vector<float> top_down(const Samples& image) {
    const std::size_t row = image.width * image.channels;
    std::vector<float> samples;
    samples.reserve(image.samples.size());
    for (std::size_t y = image.height; y-- > 0;)
        samples.insert(samples.end(), image.samples.data() + y * row, image.samples.data() + (y + 1) * row);
    return samples;
}

void encode(Imf::OStream& stream, const std::vector<ExrLayer>& layers) {
    const int width = static_cast<int>(layers[0].picture.width), height = static_cast<int>(layers[0].picture.height);
    Imf::Header header(width, height);
    Imf::FrameBuffer frame;
    std::vector<std::vector<float>> samples; // until they are written
    const char* const names[] = {"R", "G", "B"};
    for (const ExrLayer& layer : layers) {
        const std::size_t channels = layer.picture.channels;
        samples.push_back(top_down(layer.picture));
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const std::string name =
                (layer.name.empty() ? "" : layer.name + ".") + (channels == 1 ? "Y" : names[channel]);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(samples.back().data() + channel),
                                          channels * sizeof(float), layer.picture.width * channels * sizeof(float)));
        }
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
}

Samples decode(const std::filesystem::path& path) {
    Imf::InputFile file(path.string().c_str());
    const auto& window = file.header().dataWindow();
    const Imf::ChannelList& channels = file.header().channels();
    const bool is_grey = channels.findChannel("R") == nullptr;
    if (is_grey && channels.findChannel("Y") == nullptr)
        throw std::runtime_error("it has neither a channel R nor Y");
    Samples picture(static_cast<std::size_t>(window.max.x - window.min.x + 1),
                    static_cast<std::size_t>(window.max.y - window.min.y + 1), is_grey ? 1 : 3, {});
    const std::size_t row = picture.width * picture.channels;
    constexpr std::size_t most = std::size_t{1} << 30;
    if (row > most / picture.height)
        throw std::runtime_error("it is too large");
    std::vector<float> top_down(row * picture.height, 0.f);
    Imf::FrameBuffer frame;
    const char* const names[] = {"R", "G", "B"};
    // OpenEXR counts from the window's origin.
    const std::ptrdiff_t before =
        window.min.y * static_cast<std::ptrdiff_t>(row) + window.min.x * static_cast<std::ptrdiff_t>(picture.channels);
    for (std::size_t channel = 0; channel < picture.channels; ++channel)
        frame.insert(is_grey ? "Y" : names[channel],
                     Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(top_down.data() - before + channel),
                                picture.channels * sizeof(float), row * sizeof(float)));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (std::size_t y = picture.height; y-- > 0;)
        picture.samples.insert(picture.samples.end(), top_down.data() + y * row, top_down.data() + (y + 1) * row);
    return picture;
}

} // namespace

bool has_openexr() { return true; }

Samples read_exr(const std::filesystem::path& path) {
    try {
        return decode(path);
    } catch (const std::exception& error) {
        std::string reason = error.what();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw std::runtime_error("cannot read '" + path.string() + "': " + reason);
    }
}

void write_exr_layers(const std::filesystem::path& path, const std::vector<ExrLayer>& layers) {
    if (layers.empty())
        throw std::invalid_argument("write_exr_layers: there is no picture to write");
    constexpr std::size_t largest = std::numeric_limits<int>::max() / 16; // OpenEXR counts a row's bytes in int
    const Samples& first = layers[0].picture;
    for (const auto& [name, image] : layers) {
        require_writable_samples("write_exr_layers", image);
        if (image.width > largest || image.height > largest)
            throw std::invalid_argument("write_exr_layers: an image of " + std::to_string(image.width) + " x " +
                                        std::to_string(image.height) + " is too large for OpenEXR");
        if (image.width != first.width || image.height != first.height)
            throw std::invalid_argument("write_exr_layers: layer '" + name + "' has another size than the first one");
    }
    MemoryStream stream;
    try {
        encode(stream, layers);
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot write '" + path.string() + "': OpenEXR says " + error.what());
    }
    write_file(path, stream.bytes());
}

} // namespace nephroid::examples

#else

namespace nephroid::examples {

bool has_openexr() { return false; }

void write_exr_layers(const std::filesystem::path& path, const std::vector<ExrLayer>&) { require_openexr(path); }

Samples read_exr(const std::filesystem::path& path) {
    throw std::runtime_error("cannot read '" + path.string() + "': this program was built without OpenEXR");
}

} // namespace nephroid::examples

#endif

namespace nephroid::examples {

void write_exr(const std::filesystem::path& path, const Samples& image) { write_exr_layers(path, {{"", image}}); }

void require_openexr(const std::filesystem::path& path) {
    if (!has_openexr())
        throw std::runtime_error("cannot write '" + path.string() +
                                 "': this program was built without OpenEXR, choose .pfm or .png");
}

} // namespace nephroid::examples
