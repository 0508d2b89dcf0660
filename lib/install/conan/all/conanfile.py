"""The recipe for Conan 2: `conan create lib/install/conan` in a checkout, or recipes/pierce/all in its registry."""
import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class PierceConan(ConanFile):
    name = "pierce"
    description = "Exact segment, ray and moving-point queries on triangle meshes"
    license = "MIT"
    topics = ("collision-detection", "ray-casting", "geometry", "exact-arithmetic")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._root(), "include", "pierce", "version.h"))
        self.version = ".".join(re.findall(r"#define PIERCE_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "CHANGELOG.md", "include/*", "lib/*"):
            copy(self, pattern, self._root(), self.export_sources_folder)

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC
            del self.options.shared  # names are not marked for a DLL

    def configure(self):
        if self.options.get_safe("shared"):
            self.options.rm_safe("fPIC")

    def validate(self):
        if self.settings.compiler == "msvc":
            raise ConanInvalidConfiguration("pierce needs GCC 12 or Clang 14 and newer: its kernels use vector extensions")

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("fast_float/3.4.0", visible=False)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for option in ("PIERCE_BUILD_TESTS", "PIERCE_BUILD_EXAMPLES", "PIERCE_WARNINGS_AS_ERRORS"):
            toolchain.cache_variables[option] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.libs = ["pierce"]
        self.cpp_info.set_property("cmake_file_name", "pierce")
        self.cpp_info.set_property("cmake_target_name", "pierce::pierce")
        self.cpp_info.set_property("pkg_config_name", "pierce")
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["m"]
