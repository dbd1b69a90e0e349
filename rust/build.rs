// Finds the shared library kinesphere-c: in the folder KINESPHERE_LIB_DIR, or by pkg-config.
use std::env;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=KINESPHERE_LIB_DIR");
    println!("cargo:rustc-link-lib=dylib=kinesphere-c");
    let folder = env::var("KINESPHERE_LIB_DIR").unwrap_or_else(|_| folder_by_pkg_config());
    if !folder.is_empty() {
        println!("cargo:rustc-link-search=native={folder}");
        // Tests and examples of this crate find the library there when they run.
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
}

fn folder_by_pkg_config() -> String {
    let output = Command::new("pkg-config").args(["--variable=libdir", "kinesphere-c"]).output();
    match output {
        Ok(found) if found.status.success() => String::from_utf8_lossy(&found.stdout).trim().to_string(),
        _ => panic!("neither KINESPHERE_LIB_DIR nor pkg-config says where libkinesphere-c is"),
    }
}
