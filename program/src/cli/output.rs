//! Outputs: every file that a command writes is an [`Output`], whatever its contents.
//!
//! | path | rule |
//! |---|---|
//! | `-` | is standard output, for at most one output of a command. The command's text then goes to standard error |
//! | with an ending | must have an ending that fits the contents: a page is not called `.png` |
//! | chosen by the command | replaces only a file that fastphong made ([`contents`](super::contents)), unless `--force` is set |
//! | of a file that was read or written | is refused: see [`files`] |

use super::CliError;
use super::contents::Contents;
use super::files::{self, Destination};
use super::log::{to_stderr, to_stdout, to_stdout_by};
use fastphong::picture::image_file::{FilePicture, Format};
use fastphong::scene::input::has_ending;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// A file that a command writes, or standard output.
#[derive(Clone, Debug)]
pub struct Output {
    /// The flag that sets it: `--output`.
    name: &'static str,
    /// The path; `None` for standard output.
    path: Option<PathBuf>,
    contents: Contents,
    /// The check of a path before it is written.
    rule: Rule,
}

/// The check of a path before it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// For a path from the user: its ending must fit the contents.
    Ending,
    /// No check: for a picture, whose format was found from its path or `--format`, and for a path
    /// that the command chose under `--force`.
    None,
    /// For a path that the command chose: a file there must be one that fastphong made.
    Own,
}

/// `--force`, for commands that choose names of files.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ForceFlag {
    /// Replace a file even if fastphong did not make it, where the program chooses the name. A file
    /// named by a flag is always replaced
    #[arg(long)]
    pub force: bool,
}

impl Output {
    /// Makes the output at the path that the flag `name` was set to; `-` is standard output.
    pub fn new(name: &'static str, path: &Path, contents: Contents) -> Output {
        Output {
            name,
            path: (path.as_os_str() != "-").then(|| path.to_owned()),
            contents,
            rule: Rule::Ending,
        }
    }

    /// Makes the output of a page: at the path of `--output`, or else at the `default` path of the
    /// command.
    pub fn page(given: Option<&Path>, default: impl FnOnce() -> String, force: ForceFlag) -> Self {
        match given {
            Some(path) => Output::new("--output", path, Contents::Page),
            None => Output::chosen("--output", default().into(), Contents::Page, force),
        }
    }

    /// Makes an output whose path the command chooses.
    pub fn chosen(name: &'static str, path: PathBuf, contents: Contents, force: ForceFlag) -> Self {
        Output {
            name,
            path: Some(path),
            contents,
            rule: if force.force { Rule::None } else { Rule::Own },
        }
    }

    /// Makes the output of `--output` for a picture. `None` as `format` means the format of the
    /// path's ending, or PNG on standard output.
    ///
    /// # Errors
    /// If the ending names no format, or standard output is a terminal.
    pub fn of_picture(path: &Path, format: Option<Format>) -> Result<Output, CliError> {
        let is_stdout = path.as_os_str() == "-";
        if is_stdout && io::stdout().is_terminal() {
            let expected = "expected `-o FILE`, or `-o -` into a pipe or a file";
            return Err(format!("a terminal cannot show a picture file: {expected}").into());
        }
        let by_path = if is_stdout {
            Ok(Format::Png)
        } else {
            Format::of_path(path)
        };
        let contents = Contents::Picture(format.map_or(by_path, Ok)?);
        Ok(Output {
            rule: Rule::None,
            ..Output::new("--output", path, contents)
        })
    }

    /// True if this is standard output.
    pub fn is_stdout(&self) -> bool {
        self.path.is_none()
    }

    /// Returns the path of the file; `None` for standard output.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Returns the path of the file for changes; `None` for standard output.
    pub fn path_mut(&mut self) -> Option<&mut PathBuf> {
        self.path.as_mut()
    }

    /// Returns the format of a picture; `None` for other contents.
    pub fn format(&self) -> Option<Format> {
        match self.contents {
            Contents::Picture(format) => Some(format),
            _ => None,
        }
    }

    /// Returns the destination that [`files`] compares with other files.
    fn destination(&self) -> Destination<'_> {
        Destination {
            name: self.name,
            path: self.path().unwrap_or(Path::new(files::STDOUT)),
        }
    }

    /// Makes the folder of the file if it does not exist.
    ///
    /// # Errors
    /// If it cannot be made, or the path is itself a folder.
    pub fn make_folder(&self) -> Result<(), CliError> {
        let Some(path) = self.path() else {
            return Ok(());
        };
        let refused = |reason: &str| format!("{}: cannot be written: {reason}", path.display());
        if path.file_name().is_none() || path.is_dir() {
            let ending = self.contents.endings()[0];
            let reason = format!("it is a folder: expected a file, such as report/index.{ending}");
            return Err(refused(&reason).into());
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        std::fs::create_dir_all(folder).map_err(|error| refused(&error.to_string()))?;
        Ok(())
    }

    /// Checks the path by its [`Rule`].
    fn check(&self) -> Result<(), CliError> {
        let Some(path) = self.path() else {
            return Ok(());
        };
        match self.rule {
            Rule::None => Ok(()),
            Rule::Own if self.contents.is_own(path) => Ok(()),
            Rule::Own => {
                let (name, path) = (self.name, path.display());
                let problem = format!("`{name}` writes {path}, which fastphong did not make");
                let expected = "expected another folder, or `--force` to replace it";
                Err(format!("{problem}: {expected}").into())
            }
            Rule::Ending => {
                let endings = self.contents.endings();
                let is_own = endings.iter().any(|own| has_ending(path, own));
                if is_own || path.extension().is_none() {
                    return Ok(());
                }
                let (name, path, contents) = (self.name, path.display(), self.contents);
                let expected = endings.join(" or .");
                let problem =
                    format!("{path}: `{name}` writes {contents}, which does not fit its ending");
                Err(format!("{problem}: expected .{expected}").into())
            }
        }
    }

    /// Writes a picture in the format of this output. A file is written whole or not at all.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_encoded(&self, picture: &FilePicture) -> Result<(), CliError> {
        let format = self.format().expect("an output of a picture");
        self.write(|out| picture.write_to(format, out))
    }

    /// Writes a text.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_text(&self, text: &str) -> Result<(), CliError> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes the bytes of a file.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_bytes(&self, bytes: &[u8]) -> Result<(), CliError> {
        self.write(|out| out.write_all(bytes))
    }

    /// Writes the output with `write`. A file is written whole or not at all.
    ///
    /// # Errors
    /// If it cannot or must not be written.
    pub fn write(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), CliError> {
        self.check()?;
        match &self.path {
            Some(_) => files::write(self.destination(), write),
            None => to_stdout_by(write),
        }
    }
}

/// Writes the bytes of several files, all or none, and makes the folders that they need.
///
/// # Errors
/// As [`Output::write`].
pub fn write_together<'a>(
    files: impl IntoIterator<Item = (&'a Output, &'a [u8])>,
) -> Result<(), CliError> {
    let files: Vec<_> = files.into_iter().collect();
    files.iter().try_for_each(|(output, _)| output.check())?;
    let to = |(output, bytes): &(&'a Output, &'a [u8])| (output.destination(), *bytes);
    files::write_together(&files.iter().map(to).collect::<Vec<_>>())
}

/// Returns `path`, the folder that the flag `name` was set to.
///
/// # Errors
/// If it is `-`, which means standard output everywhere, or a file.
pub fn folder<'a>(name: &str, path: &'a Path) -> Result<&'a Path, CliError> {
    let problem = if path.as_os_str() == "-" {
        "`-` is standard output, not a folder".to_owned()
    } else if files::is_file(path) {
        format!("{} is a file", path.display())
    } else {
        return Ok(path);
    };
    Err(format!("{name}: {problem}: expected a folder").into())
}

/// Makes a folder if it does not exist.
///
/// # Errors
/// If it cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), CliError> {
    let refused = |error| format!("{}: cannot be made: {error}", folder.display());
    Ok(std::fs::create_dir_all(folder).map_err(refused)?)
}

/// Checks that no output is a file that the command reads, and that no two outputs are the same.
///
/// # Errors
/// If one is, even under another name.
pub fn check_places(outputs: &[&Output]) -> Result<(), CliError> {
    let mut stdout = outputs.iter().filter(|output| output.is_stdout());
    if let (Some(one), Some(two)) = (stdout.next(), stdout.next()) {
        let problem = format!("`{}` and `{}` name standard output", one.name, two.name);
        return Err(format!("{problem}: expected a file for one of them").into());
    }
    let destinations = outputs.iter().map(|output| output.destination());
    files::check(&destinations.collect::<Vec<_>>())
}

/// Checks that all outputs may be written. Call it before any work, once all files that are read
/// are registered.
///
/// # Errors
/// As [`check_places`]; if an ending does not fit the contents; or if the command chose the name of
/// a file that exists and that fastphong did not make.
pub fn check(outputs: &[&Output]) -> Result<(), CliError> {
    check_places(outputs)?;
    outputs.iter().try_for_each(|output| output.check())
}

/// Returns the paths of the outputs, one per line, without standard output.
pub fn written(outputs: &[&Output]) -> String {
    let paths = outputs.iter().filter_map(|output| output.path());
    paths.map(|path| format!("{}\n", path.display())).collect()
}

/// Prints text to standard output, or to standard error if one of the outputs is standard output.
///
/// # Errors
/// As [`to_stdout`].
pub fn print_beside(outputs: &[&Output], text: &str) -> Result<(), CliError> {
    if outputs.iter().any(|output| output.is_stdout()) {
        to_stderr(text);
        Ok(())
    } else {
        to_stdout(text)
    }
}

/// Reads `png`, `ppm` or `pfm`.
pub fn format(text: &str) -> Result<Format, String> {
    let mut formats = Format::ALL.into_iter();
    let format = formats.find(|format| format.ending() == text);
    format.ok_or_else(|| "expected png, ppm or pfm".to_owned())
}
