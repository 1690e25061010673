//! Compiles the calls into each C or C++ library that is installed; without it the program says
//! "skipped".

use std::path::{Path, PathBuf};

/// An optional library.
struct Peer {
    /// The cfg that is set if it is installed.
    cfg: &'static str,
    /// The files that call it.
    shim: &'static str,
    /// Its name for pkg-config, if it has one.
    package: Option<&'static str>,
    /// A header, and the folder of headers below a prefix: without pkg-config the library counts as
    /// installed if this header exists.
    header: &'static str,
    folder: &'static str,
    /// Further arguments for the compiler.
    define: Option<&'static str>,
    /// The libraries to link.
    libraries: &'static [&'static str],
}

const PEERS: [Peer; 3] = [
    Peer {
        cfg: "has_ode",
        shim: "shims/ode.cpp",
        package: Some("ode"),
        header: "ode/ode.h",
        folder: "include",
        define: None,
        libraries: &["ode"],
    },
    Peer {
        cfg: "has_bullet",
        shim: "shims/bullet.cpp",
        package: Some("bullet-float64"),
        header: "btBulletDynamicsCommon.h",
        folder: "include/bullet",
        define: Some("BT_USE_DOUBLE_PRECISION"),
        libraries: &["BulletDynamics-float64", "BulletCollision-float64", "LinearMath-float64"],
    },
    Peer {
        cfg: "has_siconos",
        shim: "shims/siconos.cpp",
        package: None,
        header: "numerics/lcp_cst.h",
        folder: "include/siconos",
        define: None,
        libraries: &["siconos_numerics", "siconos_externals"],
    },
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    for peer in &PEERS {
        println!("cargo:rerun-if-changed={}", peer.shim);
        println!("cargo:rustc-check-cfg=cfg({})", peer.cfg);
        println!("cargo:rustc-env={}=", peer.cfg.to_uppercase());
        if let Some(found) = peer.found() {
            peer.compile(&found);
        }
    }
}

/// The folder of a library's headers, and its version.
struct Found {
    folders: Vec<PathBuf>,
    version: String,
}

impl Peer {
    fn found(&self) -> Option<Found> {
        if let Some(package) = self.package {
            let library = pkg_config::Config::new().cargo_metadata(false).probe(package).ok()?;
            return Some(Found { folders: library.include_paths, version: library.version });
        }
        let prefixes = ["/usr", "/usr/local"];
        let folder = prefixes.map(|prefix| Path::new(prefix).join(self.folder));
        let folder = folder.into_iter().find(|folder| folder.join(self.header).exists())?;
        let folders = vec![folder.parent()?.to_path_buf(), folder.clone()];
        Some(Found { folders, version: version_of(self.libraries[0]) })
    }

    fn compile(&self, found: &Found) {
        let mut build = cc::Build::new();
        build.cpp(true).file(self.shim).opt_level(2).warnings(false).includes(&found.folders);
        if let Some(define) = self.define {
            build.define(define, None);
        }
        build.compile(&format!("shim_{}", self.cfg));
        for library in self.libraries {
            println!("cargo:rustc-link-lib={library}");
        }
        println!("cargo:rustc-cfg={}", self.cfg);
        println!("cargo:rustc-env={}={}", self.cfg.to_uppercase(), found.version);
    }
}

/// The version in the name of the shared library, if there is no other.
fn version_of(library: &str) -> String {
    let name = format!("lib{library}.so.");
    let folders =
        ["/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib", "/usr/local/lib"];
    let files =
        folders.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten().flatten();
    let versions = files.filter_map(|file| {
        let file = file.file_name().into_string().ok()?;
        file.strip_prefix(&name).map(String::from)
    });
    versions.max_by_key(String::len).map_or("version unknown".into(), |v| format!("library {v}"))
}
