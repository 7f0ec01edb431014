# Builds tact from this tree: conan create packaging/conan
from pathlib import Path
from shutil import copytree, ignore_patterns

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout

ROOT = Path(__file__).resolve().parents[2]


class Tact(ConanFile):
    name = "tact"
    license = "see LICENSE"
    description = "Finds where many deformable bodies touch"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def set_version(self):
        header = (ROOT / "engine/include/tact/version.h").read_text()
        self.version = header.split('TACT_VERSION "')[1].split('"')[0]

    def export_sources(self):
        copytree(ROOT, self.export_sources_folder, dirs_exist_ok=True,
                 ignore=ignore_patterns("build", ".git", "results", "tests", "bench"))

    def requirements(self):
        self.requires("eigen/[>=3.4 <4]", transitive_headers=True)
        self.requires("embree/[>=4]")

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.variables["BUILD_SHARED_LIBS"] = bool(self.options.shared)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install(component="library")

    def package_info(self):
        self.cpp_info.libs = ["tact"]
        self.cpp_info.set_property("cmake_target_name", "tact::tact")
        if self.options.shared:
            self.cpp_info.defines = ["TACT_SHARED"]
        else:
            self.cpp_info.sharedlinkflags = self.cpp_info.exelinkflags = ["-fopenmp"]
