// Scene, OBJ and MTL files for tests, written to a folder of their own.
#pragma once

#include "scene/scene.h"
#include "support/temporary_folder.h"
#include "util/error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace sahl::testing {

/// A folder to put a scene's files in.
struct SceneFolder {
    TemporaryFolder folder;

    fs::path write(const std::string& name, const std::string& text) const
    {
        const fs::path path = folder.path / name;
        fs::create_directories(path.parent_path());
        fs::remove(path);
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    Scene load(const std::string& name, const SceneOptions& options = {}) const
    {
        return loadScene(folder.path / name, options);
    }
};

/// The text of the badInput error that `action` throws; "" when it throws none.
inline std::string badInputOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput) << error.what();
        return error.what();
    }
    return "";
}

/// The error of loading a file, without the path of the folder.
inline std::string errorOfFile(const SceneFolder& files, const std::string& name,
                               const SceneOptions& options = {})
{
    std::string text = badInputOf([&] { files.load(name, options); });
    const std::string folder = files.folder.path.string() + "/";
    for (size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
        text.erase(at, folder.size());
    }
    return text;
}

inline Scene loadText(const std::string& name, const std::string& text,
                      const SceneOptions& options = {})
{
    SceneFolder files;
    files.write(name, text);
    return files.load(name, options);
}

inline Scene loadJson(const std::string& text, const SceneOptions& options = {})
{
    return loadText("scene.json", text, options);
}

inline Scene loadObj(const std::string& text, const SceneOptions& options = {})
{
    return loadText("mesh.obj", text, options);
}

inline std::string errorOfText(const std::string& name, const std::string& text)
{
    SceneFolder files;
    files.write(name, text);
    return errorOfFile(files, name);
}

inline std::string errorOfJson(const std::string& text)
{
    return errorOfText("scene.json", text);
}
inline std::string errorOfObj(const std::string& text)
{
    return errorOfText("mesh.obj", text);
}

/// What `action` writes to stderr.
inline std::string warningsOf(const std::function<void()>& action)
{
    ::testing::internal::CaptureStderr();
    action();
    return ::testing::internal::GetCapturedStderr();
}

inline bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// gtest assertion with both texts in the message.
#define EXPECT_CONTAINS(text, part)                                                                \
    EXPECT_PRED2(::sahl::testing::contains, std::string(text), std::string(part))

}  // namespace sahl::testing
