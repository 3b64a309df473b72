#include "scene_library.hpp"

#if SKELGEN_WITH_ASSIMP

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <skelgen/core/error.hpp>

#include "fbx_names.hpp"
#include "loaded_library.hpp"

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

/// A scene in memory as the only file that there is, open once at a time.
class SceneFile {
public:
    explicit SceneFile(std::string_view bytes) : bytes_(bytes) {
        file_.ReadProc = read;
        file_.WriteProc = [](aiFile*, const char*, std::size_t, std::size_t) { return std::size_t{0}; };
        file_.TellProc = [](aiFile* file) { return of(file->UserData).place_; };
        file_.FileSizeProc = [](aiFile* file) { return of(file->UserData).bytes_.size(); };
        file_.SeekProc = seek;
        file_.FlushProc = [](aiFile*) {};
        files_.OpenProc = open;
        files_.CloseProc = [](aiFileIO*, aiFile*) {};
        file_.UserData = files_.UserData = reinterpret_cast<aiUserData>(this);
    }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;

    aiFileIO& files() { return files_; }

    /// Its name, with the extension by which the library chooses how to read it.
    static std::string name(const char* extension) { return std::string("scene.") + extension; }

private:
    static SceneFile& of(aiUserData data) { return *reinterpret_cast<SceneFile*>(data); }

    static aiFile* open(aiFileIO* files, const char* name, const char* mode) {
        SceneFile& self = of(files->UserData);
        self.place_ = 0;
        const std::string_view asked = name;
        return (asked == SceneFile::name("fbx") || asked == SceneFile::name("dae")) && *mode == 'r' ? &self.file_
                                                                                                    : nullptr;
    }

    static std::size_t read(aiFile* file, char* to, std::size_t size, std::size_t count) {
        SceneFile& self = of(file->UserData);
        const std::size_t whole = size > 0 ? std::min(count, (self.bytes_.size() - self.place_) / size) : 0;
        std::memcpy(to, self.bytes_.data() + self.place_, whole * size);
        self.place_ += whole * size;
        return whole;
    }

    static aiReturn seek(aiFile* file, std::size_t offset, aiOrigin origin) {
        SceneFile& self = of(file->UserData);
        const std::size_t size = self.bytes_.size();
        std::size_t place = offset;
        if (origin == aiOrigin_CUR) place = self.place_ + offset;
        if (origin == aiOrigin_END) place = size - std::min(offset, size);
        if (place > size) return aiReturn_FAILURE;
        self.place_ = place;
        return aiReturn_SUCCESS;
    }

    std::string_view bytes_;
    std::size_t place_ = 0; ///< from where is read
    aiFile file_{};
    aiFileIO files_{};
};

} // namespace

void with_imported_scene(std::string_view bytes, const char* extension, const std::function<void(const aiScene&)>& use,
                         Pivots pivots) {
    const LoadedLibrary assimp(SKELGEN_ASSIMP_LIBRARY,
                               "is FBX or DAE, for which the library assimp is missing (" SKELGEN_ASSIMP_LIBRARY
                               "); install it (Debian: libassimp5), or export it as GLB");
    const auto import = assimp.function<decltype(aiImportFileExWithProperties)>("aiImportFileExWithProperties");
    const auto release = assimp.function<decltype(aiReleaseImport)>("aiReleaseImport");
    const auto error = assimp.function<decltype(aiGetErrorString)>("aiGetErrorString");
    const auto release_properties = assimp.function<decltype(aiReleasePropertyStore)>("aiReleasePropertyStore");
    const std::unique_ptr<aiPropertyStore, decltype(release_properties)> properties(
        assimp.function<decltype(aiCreatePropertyStore)>("aiCreatePropertyStore")(), release_properties);
    assimp.function<decltype(aiSetImportPropertyInteger)>("aiSetImportPropertyInteger")(
        properties.get(), AI_CONFIG_PP_RVC_FLAGS,
        aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS | aiComponent_TEXCOORDS |
            aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
    assimp.function<decltype(aiSetImportPropertyInteger)>("aiSetImportPropertyInteger")(
        properties.get(), AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, pivots == Pivots::several_nodes ? 1 : 0);

    std::string renamed;
    if (std::string_view(extension) == "fbx") {
        constexpr int first_read = 7100;
        if (const int version = version_of_fbx(bytes); version > 0 && version < first_read)
            refuse("is FBX " + std::to_string(version / 1000) + '.' + std::to_string(version / 100 % 10) +
                   ", and FBX is read from 7.1 on, of 2011; open and export it again, as FBX of today or GLB");
        renamed = with_names_apart(bytes);
        bytes = renamed;
    }
    SceneFile file(bytes);
    const std::unique_ptr<const aiScene, decltype(release)> scene(
        import(SceneFile::name(extension).c_str(), static_cast<unsigned>(aiProcess_RemoveComponent), &file.files(),
               properties.get()),
        release);
    if (scene == nullptr || scene->mRootNode == nullptr)
        refuse(std::string("cannot be read: ") + error() + "; export it again, or as GLB");
    use(*scene);
}

} // namespace skelgen::io::detail

#endif
