#pragma once

#include <dlfcn.h>
#include <memory>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

/// The functions of a C library that is loaded where it is needed, not linked: to load it would take much of the time
/// in which a program starts. For as long as this is there.
class LoadedLibrary {
public:
    /// `name`: as the loader knows it. \throws Error bad_input, with the message `if_missing`, when it is not on this
    /// machine.
    LoadedLibrary(std::string name, const std::string& if_missing)
        : name_(std::move(name)), handle_(::dlopen(name_.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
        if (!handle_) throw Error(ErrorCode::bad_input, if_missing);
    }

    /// A function by its name; its type as declared. \throws Error bad_input when there is none of this name.
    template <typename Function>
    [[nodiscard]] Function* function(const char* name) const {
        void* const found = ::dlsym(handle_.get(), name);
        if (found == nullptr)
            throw Error(ErrorCode::bad_input, "needs another version of " + name_ + ": this one has no " + name);
        return reinterpret_cast<Function*>(found);
    }

private:
    struct Close {
        void operator()(void* handle) const { ::dlclose(handle); }
    };
    std::string name_;
    std::unique_ptr<void, Close> handle_;
};

} // namespace skelgen::io::detail
