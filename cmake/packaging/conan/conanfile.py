"""A recipe for Conan 2 that lies in the repository itself and takes the sources beside it:

    conan create cmake/packaging/conan

Not tried: it was checked that this file compiles, that its version is the library's and
that the files it copies exist.
"""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy
from conan.tools.layout import basic_layout


class LjusConan(ConanFile):
    name = "ljus"
    version = "0.2.0"
    description = "Global illumination with photon maps: a book that compiles"
    license = "MIT"
    topics = ("ray-tracing", "photon-mapping", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    requires = "glm/1.0.1", "stb/cci.20240213"
    no_copy_source = True

    def export_sources(self):
        root = os.path.join(self.recipe_folder, os.pardir, os.pardir, os.pardir)
        for pattern in ("include/*.hpp", "LICENSE"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def layout(self):
        basic_layout(self, src_folder=".")

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder,
             dst=os.path.join(self.package_folder, "licenses"))
        copy(self, "*.hpp", src=os.path.join(self.source_folder, "include"),
             dst=os.path.join(self.package_folder, "include"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "ljus")
        self.cpp_info.set_property("cmake_target_name", "ljus::ljus")
        self.cpp_info.requires = ["glm::glm", "stb::stb"]
