// Options that several subcommands share.
#pragma once

#include "bvh/bvh.h"
#include "device/device.h"
#include "render/prepare.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct CommonOptions {
    std::string scenePath;  ///< empty: the built-in scene, where a command allows that
    SceneOptions scene;
    std::string device = "auto";
    DeviceOptions deviceOptions;
    BvhBuild bvhBuild = BvhBuild::automatic;
    uint32_t tileSize = 0;
    std::string progress = "auto";
    bool quiet = false;
    bool verbose = false;
};

/// Adds the options that choose and change a scene, in the groups "Scene" and "Sampling".
void addSceneOptions(CLI::App& command, CommonOptions& options);

/// Adds the options that choose a device and how work is cut up for it, in the groups "Device" and
/// "Testing": none of the latter changes a bit of the picture.
void addDeviceOptions(CLI::App& command, CommonOptions& options);

void addMessageOptions(CLI::App& command, CommonOptions& options);

/// Loads options.scenePath, or the built-in scene when it is empty.
Scene loadSceneFor(const CommonOptions& options);

/// Loads the scene and builds its tree; a saved scene (saved/saved_scene.h) has it already, and options
/// that would need another are refused (usage).
///   onceRead             called as soon as the scene is known and before the tree is built
///   onceThreadsMayStart  called before that, and before meshes are read: see SceneOptions; may be empty
PreparedScene prepareSceneFor(const CommonOptions& options, const std::function<void(const Scene&)>& onceRead,
                              const std::function<void()>& onceThreadsMayStart = {});

/// Opens options.device and tells the user what was chosen, unless --quiet.
std::unique_ptr<Device> openDeviceFor(const CommonOptions& options);

/// As openDeviceFor(), while the caller goes on: in a thread of its own the device is opened, and makes the kernels for
/// the expected scene once that is known. What the user is told, and what fails, waits for get().
class DeviceAhead {
public:
    /// Begins to open options.device; `options` must live as long as this.
    explicit DeviceAhead(const CommonOptions& options);
    ~DeviceAhead();  ///< waits until the device is open, and closes it
    DeviceAhead(const DeviceAhead&) = delete;
    DeviceAhead& operator=(const DeviceAhead&) = delete;

    /// To be called once at most, and not after get().
    void expectScene(const SceneOutline& outline);
    /// To be called once.
    std::unique_ptr<Device> get();

private:
    struct Opened {
        std::unique_ptr<Device> device;
        std::string note;
    };
    void expect(const std::optional<SceneOutline>& outline);

    const CommonOptions& options_;
    bool expected_ = false;
    std::promise<std::optional<SceneOutline>> outline_;
    std::future<Opened> opened_;
};

/// Throws deviceLost, with numbers, when there is no memory for `films` films of that size and for
/// the pictures made from them.
void requireFilmMemory(const RenderSettings& settings, unsigned films);

/// Number of host threads in force.
unsigned threadsFor(const CommonOptions& options);

}  // namespace sahl
