#include "app/outputs.h"

#include "util/error.h"

#include <exception>

namespace sahl {

namespace {

std::string extensionOf(const fs::path& path)
{
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace

void checkOutputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs)
{
    for (const fs::path& output : outputs) {
        std::string extension = extensionOf(output);
        if (extension != ".exr" && extension != ".png" && extension != ".pfm") {
            throw usageError("{}: the name must end in .exr, .pfm (linear) or .png (tone mapped)",
                             output.string());
        }
        for (const fs::path& input : inputs) {
            std::error_code ignored;
            if (fs::equivalent(output, input, ignored)) {
                throw usageError("{}: is an input; writing it would destroy it", output.string());
            }
        }
        requireWritable(output);
    }
}

void writeImage(const Image& image, const OutputOptions& options, const fs::path& path,
                const ImageMetadata& metadata)
{
    std::string extension = extensionOf(path);
    if (extension == ".exr") {
        writeFileAtomically(path, encodeExr(image, metadata));
    } else if (extension == ".pfm") {
        writeFileAtomically(path, encodePfm(image));
    } else {
        writeFileAtomically(path, encodePng(toneMap(image, options.toneMap, options.exposure), metadata));
    }
}

void writeOutputs(const Film& film, const OutputOptions& options, const ImageMetadata& metadata)
{
    Image image = meanImage(film);
    std::exception_ptr failure;
    for (const fs::path& path : options.paths) {
        try {
            writeImage(image, options, path, metadata);
        } catch (...) {
            if (!failure) failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace sahl
