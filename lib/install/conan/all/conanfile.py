"""The recipe for Conan 2."""
import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, rmdir
from conan.tools.scm import Version

required_conan_version = ">=2.0.9"


class PierceConan(ConanFile):
    name = "pierce"
    description = "Exact segment, ray and moving-point queries on triangle meshes"
    license = "MIT"
    url = "https://github.com/conan-io/conan-center-index"
    homepage = "https://github.com/pierce/pierce"
    topics = ("collision-detection", "ray-casting", "geometry", "exact-arithmetic")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("fast_float/3.4.0", visible=False)

    def validate(self):
        check_min_cppstd(self, 20)
        compiler = str(self.settings.compiler)
        oldest = {"gcc": "12", "clang": "14"}
        if compiler == "msvc" or Version(self.settings.compiler.version) < oldest.get(compiler, "0"):
            raise ConanInvalidConfiguration("pierce needs GCC 12 or Clang 14 and newer: its kernels use their vectors")
        if self.settings.os == "Windows" and self.options.shared:
            raise ConanInvalidConfiguration("pierce is static on Windows: its names are not marked for a DLL")

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")

    def source(self):
        get(self, **self.conan_data["sources"][self.version], strip_root=True)

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
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan makes files of its own for CMake and pkg-config.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))
        rmdir(self, os.path.join(self.package_folder, "share"))

    def package_info(self):
        self.cpp_info.libs = ["pierce"]
        self.cpp_info.set_property("cmake_file_name", "pierce")
        self.cpp_info.set_property("cmake_target_name", "pierce::pierce")
        self.cpp_info.set_property("pkg_config_name", "pierce")
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
