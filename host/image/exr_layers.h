// An EXR file with all that it says: its attributes, and any of its channels by name.
#pragma once

#include "image/exr_header.h"
#include "image/isolated.h"

#include <memory>

namespace sahl {

/// What stands in front of the pixels.
struct ExrDescription {
    uint32_t width = 0, height = 0;  ///< of the data window [pixels]
    ImagePlace place;                ///< in the display window
    ImageMetadata metadata;          ///< attributes that are strings
    std::map<std::string, ExrChannel> channels;
    bool operator==(const ExrDescription&) const = default;
};

/// Reads no more of the file than that. Throws badInput as readImage does.
ExrDescription describeExr(const fs::path& path);

/// Channels as they are in a file, one behind another in the order in which they were asked for: bit
/// patterns of 32 bits, top row first.
class ExrPlanes {
public:
    ExrPlanes(size_t count, size_t pixels);
    std::span<uint32_t> plane(size_t i) const;
    std::span<const uint32_t> words() const;  ///< of all of them

private:
    std::shared_ptr<const SharedMemory> memory_;
    size_t pixels_;
};

/// Reads channels of the file that `described` was made from. Throws badInput when it is another file by
/// now, has no such channel or one that is not of 32 bits at full resolution, or is damaged.
ExrPlanes readExrPlanes(const fs::path& path, const ExrDescription& described,
                        std::span<const std::string> names);

}  // namespace sahl
