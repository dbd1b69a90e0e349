// Finds the shared library kinesphere-c: in the folder KINESPHERE_LIB_DIR, or by pkg-config.
use std::env;
use std::fs;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=KINESPHERE_LIB_DIR");
    println!("cargo:rustc-link-lib=dylib=kinesphere-c");
    let folder = env::var("KINESPHERE_LIB_DIR").map_or_else(|_| folder_by_pkg_config(), checked);
    if !folder.is_empty() {
        println!("cargo:rustc-link-search=native={folder}");
        // Tests and examples of this crate find the library there when they run.
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
}

/// Returns the folder that KINESPHERE_LIB_DIR names, as an absolute path.
fn checked(named: String) -> String {
    let folder = match fs::canonicalize(&named) {
        Ok(folder) => folder,
        Err(error) => {
            panic!("KINESPHERE_LIB_DIR={named}: {error} (a relative path begins at the folder of the crate)")
        }
    };
    let has_library = fs::read_dir(&folder).map_or(false, |mut files| {
        files.any(|file| {
            file.map_or(false, |file| file.file_name().to_string_lossy().contains("kinesphere-c."))
        })
    });
    assert!(has_library, "KINESPHERE_LIB_DIR={named}: there is no libkinesphere-c.so");
    folder.to_string_lossy().into_owned()
}

fn folder_by_pkg_config() -> String {
    let output = Command::new("pkg-config").args(["--variable=libdir", "kinesphere-c"]).output();
    match output {
        Ok(found) if found.status.success() => String::from_utf8_lossy(&found.stdout).trim().to_string(),
        _ => panic!("neither KINESPHERE_LIB_DIR nor pkg-config says where libkinesphere-c is"),
    }
}
