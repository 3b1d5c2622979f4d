//! Files: read whole with a limit, replaced whole or not at all.
//!
//! A file that Gradus writes may be the only record of a person's decisions, so
//! a new text is first written beside the old one and then takes its place in
//! one step: whoever looks sees the old or the new text, also after a power
//! cut or Ctrl-C.

use std::fs::{self, File, Metadata};
use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use source::{Diagnostic, Span, codes};

/// The most bytes that are read: places are counted in 32 bits.
const LIMIT: u64 = u32::MAX as u64;

static WRITING: Mutex<()> = Mutex::new(());

/// Waits until no file is being replaced, and keeps it so while the guard
/// lives.
pub fn hold_writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Why the bytes of a file could not be had.
#[derive(Debug)]
pub enum Unreadable {
    /// The system refuses.
    Refused(io::Error),
    /// The path is a folder.
    Folder,
    /// More than 4 GiB.
    TooLarge,
}

impl Unreadable {
    /// What to tell the user. There is no text, so the place is its start.
    pub fn diagnostic(&self) -> Diagnostic {
        let start = Span::at(0);
        match self {
            Self::TooLarge => Diagnostic::new(
                codes::TOO_LARGE_FILE,
                start,
                "the file is larger than 4 GiB",
            )
            .help("give the program alone; real ones are a few megabytes"),
            Self::Folder => Diagnostic::new(
                codes::FILE_UNREADABLE,
                start,
                "this is a folder, not a file",
            )
            .help("name a file in it"),
            Self::Refused(error) => {
                let message = match error.kind() {
                    ErrorKind::NotFound => "there is no such file".to_owned(),
                    ErrorKind::PermissionDenied => "the file may not be read".to_owned(),
                    _ => error.to_string(),
                };
                Diagnostic::new(codes::FILE_UNREADABLE, start, message)
                    .help("check the path and its permissions")
            }
        }
    }
}

impl From<io::Error> for Unreadable {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::IsADirectory => Self::Folder,
            _ => Self::Refused(error),
        }
    }
}

/// The bytes of the file at `path`.
pub fn read(path: &Path) -> Result<Vec<u8>, Unreadable> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(Unreadable::Folder);
    }
    if metadata.len() > LIMIT {
        return Err(Unreadable::TooLarge);
    }
    drain(file)
}

/// The bytes that `stream` gives until it ends.
pub fn drain(stream: impl Read) -> Result<Vec<u8>, Unreadable> {
    let mut bytes = Vec::new();
    stream.take(LIMIT + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LIMIT {
        return Err(Unreadable::TooLarge);
    }
    Ok(bytes)
}

/// Gives the file at `path` new contents, in one step; makes the file if there
/// is none.
///
/// A symbolic link stays and the file it leads to is replaced. The permissions
/// stay as they are; a file that may not be written is left alone, although
/// its folder would allow the replacement. What is no regular file, such as
/// `/dev/null`, is written to, never replaced.
pub fn replace(path: &Path, contents: &[u8]) -> io::Result<()> {
    let _guard = hold_writing();
    let target = match path.symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound => return install(path, contents, None),
        Err(error) => return Err(error),
        Ok(_) => path.canonicalize()?,
    };
    let metadata = target.metadata()?;
    if metadata.is_file() {
        install(&target, contents, Some(&metadata))
    } else {
        fs::OpenOptions::new()
            .write(true)
            .open(target)?
            .write_all(contents)
    }
}

/// Writes a new file beside `target` and lets it take the place.
fn install(target: &Path, contents: &[u8], old: Option<&Metadata>) -> io::Result<()> {
    if old.is_some_and(|metadata| metadata.permissions().readonly()) {
        return Err(io::Error::new(
            ErrorKind::PermissionDenied,
            "the file is read-only",
        ));
    }
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut new = beginning(folder)?;
    new.write_all(contents)?;
    if let Some(metadata) = old {
        new.as_file().set_permissions(metadata.permissions())?;
    }
    new.as_file().sync_all()?;
    new.persist(target)?;
    Ok(())
}

/// A new, empty file in `folder` with the permissions that any new file gets.
fn beginning(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".gradus-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder).map_err(|error| {
        // The system's words name a file that nobody asked for.
        let why = match error.kind() {
            ErrorKind::NotFound => "there is no such folder",
            ErrorKind::PermissionDenied => "nothing may be written into its folder",
            _ => return error,
        };
        io::Error::new(error.kind(), why)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("a temporary folder")
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .expect("the folder")
            .map(|entry| entry.expect("an entry").file_name().into_string())
            .map(|name| name.expect("a readable name"))
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_made_then_replaced_and_nothing_is_left_beside_it() {
        let folder = folder();
        let path = folder.path().join("tank.grafcet");
        replace(&path, b"old").expect("a new file");
        replace(&path, b"new").expect("a replaced file");
        assert_eq!(read(&path).expect("the file"), b"new");
        assert_eq!(names(folder.path()), ["tank.grafcet"]);
    }

    #[test]
    fn a_folder_and_a_missing_file_cannot_be_read() {
        let folder = folder();
        assert!(matches!(read(folder.path()), Err(Unreadable::Folder)));
        let missing = read(&folder.path().join("missing")).expect_err("no file");
        assert_eq!(missing.diagnostic().message, "there is no such file");
        assert_eq!(missing.diagnostic().code, codes::FILE_UNREADABLE);
    }

    #[test]
    fn a_file_of_more_than_four_gibibytes_is_refused_unread() {
        let folder = folder();
        let path = folder.path().join("huge.l5x");
        let file = File::create(&path).expect("a new file");
        file.set_len(LIMIT + 1).expect("a file with a hole");
        assert!(matches!(read(&path), Err(Unreadable::TooLarge)));
    }

    #[cfg(unix)]
    mod on_unix {
        use std::os::unix::fs::{PermissionsExt, symlink};

        use super::*;

        fn mode(path: &Path) -> u32 {
            path.metadata().expect("metadata").permissions().mode() & 0o777
        }

        #[test]
        fn permissions_stay() {
            let folder = folder();
            let path = folder.path().join("tank.grafcet");
            fs::write(&path, "old").expect("a new file");
            fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("a mode");
            replace(&path, b"new").expect("a replaced file");
            assert_eq!(mode(&path), 0o640);
        }

        #[test]
        fn a_new_file_has_the_permissions_of_any_new_file() {
            let folder = folder();
            let ordinary = folder.path().join("ordinary");
            let made = folder.path().join("made");
            fs::write(&ordinary, "").expect("a new file");
            replace(&made, b"").expect("a new file");
            assert_eq!(mode(&made), mode(&ordinary));
        }

        #[test]
        fn a_link_stays_and_its_target_is_replaced() {
            let folder = folder();
            let target = folder.path().join("target");
            let link = folder.path().join("link");
            fs::write(&target, "old").expect("a new file");
            symlink("target", &link).expect("a link");
            replace(&link, b"new").expect("a replaced file");
            assert_eq!(read(&target).expect("the file"), b"new");
            assert!(link.symlink_metadata().expect("a link").is_symlink());
        }

        #[test]
        fn a_read_only_file_is_left_alone() {
            let folder = folder();
            let path = folder.path().join("tank.grafcet");
            fs::write(&path, "old").expect("a new file");
            fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).expect("a mode");
            let refused = replace(&path, b"new").expect_err("a refusal");
            assert_eq!(refused.kind(), ErrorKind::PermissionDenied);
            assert_eq!(read(&path).expect("the file"), b"old");
        }

        #[test]
        fn what_is_no_regular_file_is_written_to_and_stays() {
            replace(Path::new("/dev/null"), b"gone").expect("a sink");
            assert!(!Path::new("/dev/null").metadata().expect("a sink").is_file());
        }
    }
}
