//! Packs the library and its description as `rotor.fmu`: `cargo run --release --bin fmu`.

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::error::Error;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::PathBuf;

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo builds the library with this program, which is in the folder above.
    let folder = std::env::current_exe()?;
    let folder = folder.parent().ok_or("a program is in a folder")?;
    let library = folder.join("deps").join(format!("{DLL_PREFIX}rotor{DLL_SUFFIX}"));
    let system = match OS {
        "macos" => "darwin",
        other => other,
    };
    let file = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("rotor.fmu"), PathBuf::from);
    let mut archive = ZipWriter::new(File::create(&file)?);
    let options = SimpleFileOptions::default();
    archive.start_file("modelDescription.xml", options)?;
    archive.write_all(rotor::fmi::description().as_bytes())?;
    archive.start_file(format!("binaries/{ARCH}-{system}/rotor{DLL_SUFFIX}"), options)?;
    let content = fs::read(&library).map_err(|error| format!("{}: {error}", library.display()))?;
    archive.write_all(&content)?;
    archive.finish()?;
    println!("{}", file.display());
    Ok(())
}
