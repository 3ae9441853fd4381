//! Files as other programs read them: tables by the crate `csv`, summaries by `serde_json`, SVG and VTK files by an XML
//! parser, images by the crate `png`. All values are compared with those that were written.

mod images;
mod paraview;
mod svg;
mod tables;

use std::path::PathBuf;

/// Directory of a test, removed in the end.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("motile-reading-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory");
        Self(path)
    }

    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).expect(name)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// True if the values of two lists differ by at most `tolerance`.
fn near(read: &[f64], written: &[f64], tolerance: f64) -> bool {
    read.len() == written.len() && read.iter().zip(written).all(|(a, b)| (a - b).abs() <= tolerance)
}
