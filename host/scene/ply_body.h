// The values behind the header of a PLY file, in order, whether written as text or as bytes.
#pragma once

#include "scene/ply_header.h"

namespace sahl {

/// Walks over the items (vertices, faces and so on) of a body. In text an item is a line. Memory is
/// the caller's matter: what requireRoom and listLength let through is bounded by the file's
/// length. All functions throw badInput naming file and line or byte where the file does not hold
/// what they ask for.
class PlyBody {
public:
    /// `bytes` is the whole file and must outlive this object.
    PlyBody(std::string_view bytes, const PlyHeader& header, const std::string& file);

    /// Refuses a number of items that the rest of the file is too short for. The items that follow
    /// are those of `element`, which must outlive them.
    void beginElement(const PlyElement& element);

    void beginItem(uint64_t index);
    double value(const PlyProperty& property);  ///< NaN for what is not finite or no float's range
    uint64_t listLength(const PlyProperty& property);  ///< that many value()s can follow
    void skip(const PlyProperty& property);
    void endItem();

    /// Bytes behind the last item, blank lines of a text aside.
    size_t bytesLeft() const;

    /// "FILE:LINE", or "FILE: byte N (face 7)": the value that was read last.
    std::string where() const;

private:
    bool isText() const { return format_ == PlyFormat::ascii; }
    double scalar(PlyType type, const PlyProperty& property);
    double number(std::string_view word, const PlyProperty& property) const;

    PlyFormat format_;
    std::string file_;
    size_t size_;            ///< of the file
    std::string_view rest_;  ///< of the file
    std::string_view line_;  ///< rest of the line, in text
    size_t lineNumber_;      ///< in text
    size_t valueAt_ = 0;     ///< byte at which the last value begins, in bytes
    const PlyElement* element_ = nullptr;
    uint64_t index_ = 0;  ///< of the item
};

}  // namespace sahl
