//! Paths of the files that a run reads and writes, no two of which may be the same file.

use std::path::{Component, Path, PathBuf};

use anyhow::{Result, bail};

/// Most symbolic links on the way to a file.
const MOST_LINKS: usize = 40;

/// Files of a run with their names in messages.
#[derive(Debug, Default)]
pub(crate) struct Places {
    known: Vec<(String, PathBuf)>,
}

impl Places {
    /// Adds a file that is read or written.
    ///
    /// # Errors
    /// Returns an error for a file that is already known under another path or link, or lies above or below one.
    pub(crate) fn add(&mut self, what: String, path: &Path) -> Result<()> {
        let path = resolved(path);
        self.check(&what, &path, |there| path.starts_with(there) || there.starts_with(&path))?;
        self.known.push((what, path));
        Ok(())
    }

    /// Checks a directory, which may contain files of the run.
    ///
    /// # Errors
    /// Returns an error for a directory that is a file of the run, or below one.
    pub(crate) fn check_directory(&self, what: &str, path: &Path) -> Result<()> {
        let path = resolved(path);
        self.check(what, &path, |there| path.starts_with(there))
    }

    fn check(&self, what: &str, path: &Path, clashes: impl Fn(&Path) -> bool) -> Result<()> {
        for (other, there) in &self.known {
            let is_one = path == there || is_linked(path, there);
            if is_one || clashes(there) {
                let (one, two) = (path.display(), there.display());
                let relation = if is_one {
                    format!("are one file ({one})")
                } else {
                    format!("lie one in the other ({one}, {two})")
                };
                bail!("{what} and {other} {relation}, so one of them would be lost. Use different names");
            }
        }
        Ok(())
    }
}

/// Returns true if two paths lead to one file, which need not exist.
pub(crate) fn are_one(here: &Path, there: &Path) -> bool {
    let [here, there] = [here, there].map(resolved);
    here == there || is_linked(&here, &there)
}

/// Returns the path without `.`, `..` and symbolic links, also of a file that does not exist yet.
fn resolved(path: &Path) -> PathBuf {
    let mut links = MOST_LINKS;
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    follow(PathBuf::new(), &path, &mut links)
}

fn follow(mut place: PathBuf, path: &Path, links: &mut usize) -> PathBuf {
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                place.pop();
            }
            Component::Prefix(_) | Component::RootDir => place.push(component),
            Component::Normal(name) => match place.join(name).read_link() {
                Ok(target) if *links > 0 => {
                    *links -= 1;
                    place = follow(place, &target, links);
                }
                _ => place.push(name),
            },
        }
    }
    place
}

/// Returns true if two paths are hard links to one file.
#[cfg(unix)]
fn is_linked(here: &Path, there: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let file =
        |path: &Path| path.metadata().ok().filter(std::fs::Metadata::is_file).map(|data| (data.dev(), data.ino()));
    file(here).is_some() && file(here) == file(there)
}

/// Hard links cannot be recognised on this system.
#[cfg(not(unix))]
fn is_linked(_here: &Path, _there: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests;
