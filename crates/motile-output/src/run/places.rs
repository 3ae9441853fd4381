//! Files that a run reads and writes: none of them may be another one.

use std::path::{Component, Path, PathBuf};

use anyhow::{Result, bail};

/// Most symbolic links on the way to a file.
const MOST_LINKS: usize = 40;

/// Files and directories of a run, each with the words for it in a message.
#[derive(Debug, Default)]
pub(crate) struct Places {
    known: Vec<(String, PathBuf)>,
}

impl Places {
    /// Adds a file that is read or written.
    ///
    /// # Errors
    /// One that is another place by whatever path or link, or that another place is below.
    pub(crate) fn add(&mut self, what: String, path: &Path) -> Result<()> {
        let path = resolved(path);
        self.check(&what, &path, |there| path.starts_with(there) || there.starts_with(&path))?;
        self.known.push((what, path));
        Ok(())
    }

    /// Makes sure of a directory, which files may be in.
    ///
    /// # Errors
    /// One that is a file of the run, or below one.
    pub(crate) fn check_directory(&self, what: &str, path: &Path) -> Result<()> {
        let path = resolved(path);
        self.check(what, &path, |there| path.starts_with(there))
    }

    fn check(&self, what: &str, path: &Path, clashes: impl Fn(&Path) -> bool) -> Result<()> {
        for (other, there) in &self.known {
            if clashes(there) || is_linked(path, there) {
                bail!(
                    "{what} and {other} are one file ({}), of which one would be lost: give them different names",
                    path.display()
                );
            }
        }
        Ok(())
    }
}

/// Whether two paths are of one file, there or not.
pub(crate) fn are_one(here: &Path, there: &Path) -> bool {
    let [here, there] = [here, there].map(resolved);
    here == there || is_linked(&here, &there)
}

/// The path without `.`, `..` and symbolic links, also of a file or directory that is not there yet.
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

/// Whether two paths are hard links to one file.
#[cfg(unix)]
fn is_linked(here: &Path, there: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let file =
        |path: &Path| path.metadata().ok().filter(std::fs::Metadata::is_file).map(|data| (data.dev(), data.ino()));
    file(here).is_some() && file(here) == file(there)
}

/// Whether two paths are hard links to one file: not known here.
#[cfg(not(unix))]
fn is_linked(_here: &Path, _there: &Path) -> bool {
    false
}

#[cfg(test)]
mod tests;
