//! Writes files that are replaced as a whole or not at all.

use std::borrow::ToOwned;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::vec::Vec;

use tempfile::{Builder, NamedTempFile, TempPath};

use super::ImageFileError;

/// How many links are followed one after the other: as many as Linux follows.
const MOST_LINKS: usize = 40;

/// The drafts on the disk, and folders that were made for them, for [`remove_drafts`].
static DRAFTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Writes a file that is either complete or not there. A draft is written beside it first, and then
/// renamed.
///
/// An existing file is replaced and its permissions are kept. It stays unchanged if anything fails,
/// even the power: the new bytes are on the disk before they take its name. If there was no file,
/// there is nothing to lose, and the disk is not waited for. A killed process then leaves a
/// complete file or none, but a machine that stops within seconds may leave a truncated one. If two
/// processes write one file, the last one's bytes stay, complete. Links are followed, even to files
/// that do not exist yet. Something other than a plain file, such as a pipe or a device, is written
/// to directly.
///
/// A process that is ended from outside leaves its draft, named `.tmp` and some letters, unless it
/// calls `remove_drafts` first.
///
/// # Errors
/// If the directory does not exist or cannot be written to, the path is a directory or a read-only
/// file, or the disk is full.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ImageFileError> {
    write_file_by(path, |file| file.write_all(bytes))
}

/// Writes a file as [`write_file`] does, with the bytes that `write` writes.
///
/// # Errors
/// As for [`write_file`], and if `write` fails.
pub fn write_file_by(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), ImageFileError> {
    replace(path, |file| write(file)).map_err(|cause| unwritten(path, cause))
}

/// Files to write, all or none. Each is a draft until [`Replacements::finish`] renames them all.
/// Missing folders are created. If anything fails, or this is dropped before, every file is as it
/// was. A signal that makes the program call [`remove_drafts`] waits while drafts are renamed. A
/// process that is killed between two renames leaves some files new and others old, each of them
/// complete.
#[derive(Default)]
pub struct Replacements {
    waiting: Vec<Waiting>,
    // Dropped after the drafts, so that the folders are empty by then.
    made: MadeFolders,
}

impl Replacements {
    /// Writes the draft of a file.
    ///
    /// # Errors
    /// As for [`write_file`].
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), ImageFileError> {
        let file = Waiting::new(path, &mut self.made, |file| file.write_all(bytes));
        self.waiting
            .push(file.map_err(|cause| unwritten(path, cause))?);
        Ok(())
    }

    /// Renames all drafts, or none.
    ///
    /// # Errors
    /// If one cannot be renamed, or a file cannot be backed up before.
    pub fn finish(mut self) -> Result<(), ImageFileError> {
        for file in &mut self.waiting {
            let backup = backup(&file.place).map_err(|cause| unwritten(&file.place, cause));
            file.backup = backup?;
        }
        // Holding the list makes a signal handler, which would remove drafts and backups, wait.
        let held = drafts();
        for (i, file) in self.waiting.iter().enumerate() {
            let Err(cause) = fs::rename(&file.draft.1, &file.place) else {
                continue;
            };
            for file in &self.waiting[..i] {
                // These renames and removals were possible a moment ago.
                let _ = match &file.backup {
                    Some((_, backup)) => fs::rename(backup, &file.place),
                    None => fs::remove_file(&file.place),
                };
            }
            return Err(unwritten(&file.place, cause));
        }
        drop(held);
        self.made.0.clear();
        Ok(())
    }
}

/// Returns the error of a file that cannot be written.
fn unwritten(path: &Path, cause: io::Error) -> ImageFileError {
    ImageFileError::Write {
        path: path.to_owned(),
        cause,
    }
}

/// A complete draft that waits to be renamed.
struct Waiting {
    place: PathBuf,
    draft: (ListedDraft, TempPath),
    /// The old file, from the moment when the drafts are renamed.
    backup: Option<(ListedDraft, TempPath)>,
}

impl Waiting {
    fn new(
        path: &Path,
        made: &mut MadeFolders,
        write: impl FnOnce(&mut File) -> io::Result<()>,
    ) -> io::Result<Waiting> {
        let old = replaceable(path)?;
        let place = place(path);
        if old.as_ref().is_some_and(|old| !old.is_file()) {
            let problem = "it is no plain file";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
        made.make(folder(&place))?;
        let (listed, draft) = complete_draft(&place, old.as_ref(), write)?;
        Ok(Waiting {
            draft: (listed, draft.into_temp_path()),
            backup: None,
            place,
        })
    }
}

/// Gives the file at `place`, if there is one, a second name, so that it can come back as it was,
/// with its owner and its hard links. Copies it if the system refuses.
fn backup(place: &Path) -> io::Result<Option<(ListedDraft, TempPath)>> {
    let old = fs::symlink_metadata(place).ok();
    // A folder cannot be replaced, so the rename will fail.
    let Some(old) = old.filter(|old| !old.is_dir()) else {
        return Ok(None);
    };
    let mut drafts = drafts();
    if let Ok(link) = Builder::new().make_in(folder(place), |link| fs::hard_link(place, link)) {
        drafts.push(link.path().to_owned());
        return Ok(Some((
            ListedDraft(link.path().to_owned()),
            link.into_temp_path(),
        )));
    }
    drop(drafts);
    let (listed, copy) = complete_draft(place, Some(&old), |file| {
        io::copy(&mut File::open(place)?, file).map(|_| ())
    })?;
    Ok(Some((listed, copy.into_temp_path())))
}

/// Folders that were created. They are removed again on drop, or by [`remove_drafts`].
#[derive(Default)]
struct MadeFolders(Vec<ListedDraft>);

impl MadeFolders {
    /// Creates a folder and its missing parents.
    fn make(&mut self, folder: &Path) -> io::Result<()> {
        let missing = folder.ancestors().take_while(|above| {
            let is_named = **above != *"";
            is_named && !above.exists()
        });
        for folder in missing.collect::<Vec<_>>().into_iter().rev() {
            let mut drafts = drafts();
            fs::create_dir(folder)?;
            drafts.push(folder.to_owned());
            self.0.push(ListedDraft(folder.to_owned()));
        }
        Ok(())
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            // A folder that is not empty now has files of other processes.
            let _ = fs::remove_dir(&folder.0);
        }
    }
}

/// Removes the drafts of all files that are being written. Call it when a signal is about to end
/// the program. While the result lives, every thread that wants to write a file waits.
pub fn remove_drafts() -> NoDrafts {
    let drafts = drafts();
    // A folder was listed before the drafts in it.
    for draft in drafts.iter().rev() {
        // A draft that has just been renamed is not there any more.
        let _ = fs::remove_file(draft).or_else(|_| fs::remove_dir(draft));
    }
    NoDrafts { _held: drafts }
}

/// A guard during which no file is written: see [`remove_drafts`].
#[derive(Debug)]
pub struct NoDrafts {
    _held: MutexGuard<'static, Vec<PathBuf>>,
}

fn drafts() -> MutexGuard<'static, Vec<PathBuf>> {
    DRAFTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// An entry of [`DRAFTS`], for as long as this lives.
struct ListedDraft(PathBuf);

impl Drop for ListedDraft {
    fn drop(&mut self) {
        let mut drafts = drafts();
        // The first of many drafts is dropped first.
        if let Some(i) = drafts.iter().position(|draft| *draft == self.0) {
            drafts.remove(i);
        }
    }
}

/// Creates an empty file in `folder` with the permissions of `old`, and lists it. Every draft on
/// the disk is listed.
fn draft(folder: &Path, old: Option<&Metadata>) -> io::Result<(ListedDraft, NamedTempFile)> {
    #[cfg_attr(not(unix), allow(unused_mut))] // permissions are Unix's
    let mut new = Builder::new();
    #[cfg(unix)]
    {
        // Other users may read a new file by default. A file that was hidden from them must stay
        // hidden while it is rewritten.
        let any = std::os::unix::fs::PermissionsExt::from_mode(0o666);
        new.permissions(old.map_or(any, Metadata::permissions));
    }
    #[cfg(not(unix))]
    let _ = old;
    let mut drafts = drafts();
    let draft = new.tempfile_in(folder)?;
    drafts.push(draft.path().to_owned());
    Ok((ListedDraft(draft.path().to_owned()), draft))
}

/// Returns the real path of a file. Links are followed, even to files that do not exist yet.
pub fn place(path: &Path) -> PathBuf {
    if let Ok(place) = fs::canonicalize(path) {
        return place;
    }
    let mut end = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(target) = fs::read_link(&end) else {
            break;
        };
        // A relative target starts at the folder of the link; an absolute one replaces the path.
        end = end.with_file_name("").join(target);
    }
    match (fs::canonicalize(folder(&end)), end.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => end,
    }
}

fn folder(path: &Path) -> &Path {
    let folder = path.parent().filter(|folder| *folder != "");
    folder.unwrap_or(Path::new("."))
}

/// Writes a draft beside the real path of `path`, then renames it.
fn replace(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let old = replaceable(path)?;
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return write(&mut OpenOptions::new().write(true).open(path)?);
    }
    let place = place(path);
    let (_listed, draft) = complete_draft(&place, old.as_ref(), write)?;
    draft.persist(place)?;
    Ok(())
}

/// Returns the file at `path`, if there is one.
///
/// # Errors
/// If it is a folder, or read-only.
fn replaceable(path: &Path) -> io::Result<Option<Metadata>> {
    let old = match fs::metadata(path) {
        Ok(old) => old,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    if old.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory));
    }
    // A rename would ignore that the file is read-only.
    if old.is_file() && old.permissions().readonly() {
        let problem = "the file there is read-only";
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, problem));
    }
    Ok(Some(old))
}

/// Writes a draft beside `place`, with the permissions of the `old` file there.
fn complete_draft(
    place: &Path,
    old: Option<&Metadata>,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<(ListedDraft, NamedTempFile)> {
    let draft = draft(folder(place), old);
    let problem = "its folder does not exist or takes no files";
    let (listed, mut draft) = draft.map_err(|error| io::Error::new(error.kind(), problem))?;
    write(draft.as_file_mut())?;
    if let Some(old) = old {
        draft.as_file().set_permissions(old.permissions())?;
        // Without this a loss of power could destroy both files: the name may reach the disk before
        // the bytes.
        draft.as_file().sync_all()?;
    }
    Ok((listed, draft))
}

#[cfg(test)]
mod tests {
    use std::format;
    use std::string::ToString;
    use std::vec::Vec;

    use super::*;
    use tempfile::{TempDir, tempdir};

    fn names(directory: &TempDir) -> Vec<std::ffi::OsString> {
        fs::read_dir(directory)
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect()
    }

    #[test]
    fn writes_and_replaces() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("out.bin");
        for bytes in [b"long first text" as &[u8], b"short", b""] {
            write_file(&path, bytes).unwrap();
            assert_eq!(fs::read(&path).unwrap(), bytes);
            assert_eq!(names(&directory), ["out.bin"], "nothing else is left");
        }
    }

    #[test]
    fn several_files_are_written_or_none() {
        let directory = tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        let [old, other, new] = ["old", "other", "in/two/new"].map(path);
        fs::write(&old, "old").unwrap();
        fs::write(&other, "other").unwrap();
        let paths = [&*old, &*new, &*other];
        let drafted = || {
            let mut files = Replacements::default();
            for path in paths {
                files.add(path, b"x")?;
            }
            Ok::<_, ImageFileError>(files)
        };
        // The other name of a hard link shows whether the old file came back, or a copy.
        let elsewhere = tempdir().unwrap();
        let linked = elsewhere.path().join("linked");
        fs::hard_link(&old, &linked).unwrap();
        let state = || {
            let mut file = OpenOptions::new().append(true).open(&linked).unwrap();
            file.write_all(b"!").unwrap();
            assert_eq!(fs::read(&old).unwrap(), fs::read(&linked).unwrap());
            fs::write(&linked, "old").unwrap();
            (fs::read(&old).unwrap(), names(&directory).len())
        };
        // Drafts that get no names are removed, and so are the folders that were made for them.
        drop(drafted().unwrap());
        assert_eq!(state(), (b"old".to_vec(), 2));
        // The last file cannot be drafted.
        fs::remove_file(&other).unwrap();
        fs::create_dir(&other).unwrap();
        let failed = drafted().err().unwrap();
        assert!(failed.to_string().contains("other"));
        assert_eq!(state(), (b"old".to_vec(), 2));
        // It cannot be renamed, after the others were.
        fs::remove_dir(&other).unwrap();
        let files = drafted().unwrap();
        fs::create_dir(&other).unwrap();
        assert!(files.finish().is_err(), "a folder has its name");
        assert_eq!(state(), (b"old".to_vec(), 2));
        assert!(!new.exists() && !path("in").exists() && other.is_dir());
        fs::remove_dir(&other).unwrap();
        drafted().unwrap().finish().unwrap();
        let contents = paths.map(|path| fs::read_to_string(path).unwrap());
        assert_eq!(contents, ["x"; 3]);
        assert_eq!(names(&directory).len(), 3, "no draft and no backup is left");
        let is_ours = |draft: &PathBuf| draft.starts_with(directory.path());
        assert!(!drafts().iter().any(is_ours));
    }

    #[test]
    fn a_failure_half_way_keeps_the_old_file_and_leaves_no_draft() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("out.bin");
        let fail = |file: &mut File| {
            file.write_all(b"half")?;
            Err(io::Error::other("disk full"))
        };
        assert_eq!(replace(&path, fail).unwrap_err().to_string(), "disk full");
        assert!(names(&directory).is_empty());
        fs::write(&path, "old").unwrap();
        assert_eq!(replace(&path, fail).unwrap_err().to_string(), "disk full");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(&directory), ["out.bin"]);
    }

    #[test]
    fn places_that_cannot_be_written_are_errors() {
        let directory = tempdir().unwrap();
        let plain = directory.path().join("plain");
        fs::write(&plain, "old").unwrap();
        let cases = [
            directory.path().join("missing/out.bin"),
            plain.join("out.bin"),
            directory.path().to_owned(),
        ];
        for path in cases {
            let message = write_file(&path, b"new").unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("{}: cannot be written: ", path.display())),
                "{message}"
            );
        }
        assert!(write_file(Path::new(""), b"new").is_err());
        assert_eq!(fs::read(&plain).unwrap(), b"old");
        assert_eq!(names(&directory), ["plain"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_directory_that_takes_no_files_is_an_error() {
        // The kernel refuses whoever asks; permissions would not stop the superuser.
        assert!(write_file(Path::new("/proc/self/out.bin"), b"new").is_err());
    }

    #[test]
    fn a_read_only_file_is_kept() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("out.bin");
        fs::write(&path, "old").unwrap();
        let mut permissions = fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        let message = write_file(&path, b"new").unwrap_err().to_string();
        assert!(
            message.ends_with("out.bin: cannot be written: the file there is read-only"),
            "{message}"
        );
        assert_eq!(fs::read(&path).unwrap(), b"old");
    }

    /// The link stays, and the file that it leads to is created, through other links and relative
    /// to their folders.
    #[cfg(unix)]
    #[test]
    fn a_dangling_link_is_followed() {
        use std::os::unix::fs::symlink;
        let directory = tempdir().unwrap();
        fs::create_dir(directory.path().join("folder")).unwrap();
        let (first, second) = (
            directory.path().join("first"),
            directory.path().join("folder/second"),
        );
        symlink("folder/second", &first).unwrap();
        symlink("../end", &second).unwrap();
        for bytes in [b"new" as &[u8], b"newer"] {
            write_file(&first, bytes).unwrap();
            assert_eq!(fs::read(directory.path().join("end")).unwrap(), bytes);
            for link in [&first, &second] {
                assert!(fs::symlink_metadata(link).unwrap().is_symlink());
            }
        }
        let absolute = directory.path().join("absolute");
        symlink(directory.path().join("other end"), &absolute).unwrap();
        write_file(&absolute, b"new").unwrap();
        assert_eq!(
            fs::read(directory.path().join("other end")).unwrap(),
            b"new"
        );
        // Links to a missing folder, or in a circle, cannot be written through.
        let (lost, around) = (
            directory.path().join("lost"),
            directory.path().join("around"),
        );
        symlink("missing/end", &lost).unwrap();
        symlink("around", &around).unwrap();
        for link in [lost, around] {
            assert!(write_file(&link, b"new").is_err());
            assert!(fs::symlink_metadata(link).unwrap().is_symlink());
        }
        let names = names(&directory);
        assert_eq!(names.len(), 7, "no draft is left: {names:?}");
    }

    /// A file that is hidden from other users stays hidden while it is rewritten.
    #[cfg(unix)]
    #[test]
    fn a_draft_has_the_permissions_of_the_file_that_it_replaces() {
        use std::os::unix::fs::PermissionsExt;
        let directory = tempdir().unwrap();
        let path = directory.path().join("out.bin");
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
        let look = |file: &mut File| {
            assert_eq!(file.metadata()?.permissions().mode() & 0o777, 0o600);
            Ok(())
        };
        replace(&path, look).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn permissions_links_and_sockets_stay_what_they_are() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let directory = tempdir().unwrap();
        let (file, link) = (directory.path().join("file"), directory.path().join("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&file, &link).unwrap();
        write_file(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(
            fs::metadata(&file).unwrap().permissions().mode() & 0o777,
            0o640
        );

        // A socket stands for pipes and devices. It is opened directly, which fails, and is not
        // replaced.
        let socket = directory.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        assert!(write_file(&socket, b"new").is_err());
        assert!(!fs::metadata(&socket).unwrap().is_file());
    }
}
